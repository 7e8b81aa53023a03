// bench_sensing: compares what an explorer knows of the space around it with the map of key frames and with the world
// map. Creates the pictures and tables of docs/sensing.md. Prints the tables. With --write FOLDER, writes the pictures
// into FOLDER/images, and the tables into FOLDER/sensing.md if that page exists.
#include <CLI/CLI.hpp>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "bench/sensing/tables.hpp"
#include "process/files/atomic_file.hpp"
#include "process/program.hpp"

namespace {

namespace fs = std::filesystem;
using namespace skein::bench;

struct Options {
  bool quick = false;
  fs::path write, vendors;
};

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw skein::InputError(file.string() + ": cannot be read");
  return std::move(text).str();
}

void write(const fs::path& folder, const std::vector<SiteStudy>& studies, const std::vector<Table>& tables) {
  fs::create_directories(folder / "images");
  for (const SiteStudy& study : studies) {
    const std::string stem = "sensing-" + study.stem;
    skein::write_file_atomically(folder / "images" / (stem + "-level.svg"), picture_svg(study.level));
    skein::write_file_atomically(folder / "images" / (stem + "-upright.svg"), picture_svg(study.upright));
  }
  const fs::path file = folder / "sensing.md";
  if (!fs::exists(file)) return;
  std::string page = text_of(file);
  for (const Table& table : tables) page = with_table(page, table);
  skein::write_file_atomically(file, page);
}

int run(const Options& options, std::uint64_t seed) {
  const std::vector<double> times_s = options.quick ? std::vector{1.0, 2.0} : std::vector{4.0, 8.0, 30.0};
  const std::vector<double> widths_m = options.quick ? std::vector{0.05} : std::vector{0.02, 0.05, 0.1, 0.2};
  std::vector<SiteStudy> studies;
  for (const Site& site : {loose_box(), lattice()}) studies.push_back(study_of(site, times_s, seed));
  std::vector<Table> tables = {space_table(studies), surface_table(studies),
                               reach_table(reaches(widths_m, seed), stops(seed)), message_table(studies)};
  if (!options.vendors.empty()) tables.push_back(vendor_table(nlohmann::json::parse(text_of(options.vendors))));
  tables.push_back(cost_table(studies));
  for (const Table& table : tables) std::cout << "## " << table.name << "\n\n" << table.markdown << "\n";
  if (!options.write.empty()) write(options.write, studies, tables);
  return skein::kExitDone;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  const auto add_options = [&](CLI::App& app) {
    app.add_flag("--quick", options.quick, "Two seconds of flight and members of 5 cm only");
    app.add_option("--write", options.write, "Folder for images/ and of sensing.md");
    app.add_option("--vendors", options.vendors, "JSON: what a step takes over each vendor");
  };
  return skein::run_program(
      "bench_sensing", argc, argv, add_options,
      [&](const skein::ProgramOptions& program, skein::StopSignal&) { return run(options, program.seed); });
}
