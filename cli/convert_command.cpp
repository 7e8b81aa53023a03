#include "cli/convert_command.hpp"

#include <CLI/CLI.hpp>

#include "cli/fault_tests/conversion.hpp"
#include "cli/fault_tests/fault_test.hpp"
#include "process/files/atomic_file.hpp"
#include "process/program.hpp"

namespace skein::cli {
namespace {

/// A fault test as it is, and its text for this version.
struct Conversion {
  std::filesystem::path file;
  std::string before, after;
};

Conversion conversion_of(const std::filesystem::path& file) {
  const ConfigDocument document = read_config_document(file);
  return {file, document.text, converted(document)};
}

}  // namespace

void add_convert(CLI::App& app, ConvertOptions& convert) {
  CLI::App* command = app.add_subcommand("convert", "Convert fault tests of earlier versions for this version");
  command->add_option("FILE", convert.files, "Fault test, or a folder of them")->required();
  command->add_flag("--in-place", convert.in_place, "Rewrite the files (default: print their new text)");
  command->footer(
      "Examples:\n"
      "  skein convert my_tests/outage.yaml\n"
      "  skein convert --in-place my_tests\n\n"
      "Keys of `expect` that became properties are converted (docs/how-to-test-faults.md).");
}

int convert_files(const ConvertOptions& options, const Console& console) {
  std::vector<Conversion> all;  // converted before the first file is written: an error leaves every file unchanged
  for (const std::filesystem::path& path : options.files) {
    for (const std::filesystem::path& file : fault_test_files(path)) all.push_back(conversion_of(file));
  }
  for (const auto& [file, before, after] : all) {
    if (!options.in_place) {
      console.out << after << std::flush;
      continue;
    }
    if (after != before) replace_or_overwrite(file, after);
    console.out << file.string() << ": " << (after == before ? "nothing to convert" : "converted") << std::endl;
  }
  return kExitDone;
}

}  // namespace skein::cli
