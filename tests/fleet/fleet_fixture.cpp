#include "fleet_fixture.hpp"

#include <signal.h>
#include <stdlib.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <regex>

#include "core/text/text.hpp"
#include "json_schema.hpp"
#include "process/host/host_lock.hpp"
#include "results_page.hpp"
#include "shared_memory.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;

/// The word after `option`; empty when there is none.
std::string value_of(const std::vector<std::string>& words, const std::string& option) {
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    if (words[i] == option) return words[i + 1];
  }
  return "";
}

/// Value of the variable `name`; empty when it is not set.
std::string variable(const std::vector<std::string>& variables, const std::string& name) {
  for (const std::string& entry : variables) {
    if (entry.starts_with(name + "=")) return entry.substr(name.size() + 1);
  }
  return "";
}

/// Adds the paths of the shipped configuration, wherever the build folder is, and of a cache that only the test uses.
Environment with_config(Environment environment, const fs::path& folder) {
  environment.try_emplace("XDG_CACHE_HOME", folder / "cache");
  if (std::getenv("SKEIN_CONFIG_DIR") == nullptr) {
    environment.try_emplace("SKEIN_CONFIG_DIR", source_path("config"));
  }
  return environment;
}

}  // namespace

bool long_tests() {
  const char* asked = std::getenv("SKEIN_LONG");
  return asked != nullptr && std::string(asked) == "1";
}

std::string program(const std::string& name) { return build_path("bin/") + name; }

std::vector<std::map<std::string, std::string>> read_csv(const fs::path& file, LastLine last) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> columns = split(line, ',');
  std::vector<std::map<std::string, std::string>> rows;
  while (std::getline(in, line)) {
    if (in.eof() && last == LastLine::may_be_unfinished) break;
    const std::vector<std::string> cells = split(line, ',');
    if (cells.size() != columns.size()) throw std::runtime_error(file.string() + ": odd line: " + line);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (i == 0) rows.emplace_back();
      rows.back()[columns[i]] = cells[i];
    }
  }
  return rows;
}

std::map<std::string, pid_t> processes_of(const fs::path& dir) {
  std::map<std::string, pid_t> found;
  std::error_code ignored;
  for (fs::directory_iterator it("/proc", ignored), end; it != end; it.increment(ignored)) {
    const std::string pid = it->path().filename();
    if (pid.find_first_not_of("0123456789") != std::string::npos) continue;
    const std::vector<std::string> words = split(text_of(it->path() / "cmdline"), '\0');
    if (words[0].empty()) continue;
    const std::vector<std::string> variables = split(text_of(it->path() / "environ"), '\0');
    if (value_of(words, "--out") == dir) {
      const std::string uav = value_of(words, "--uav");
      found[fs::path(words[0]).filename().string() + (uav.empty() ? "" : "-" + uav)] = std::stoi(pid);
    } else if (variable(variables, "SKEIN_OUT") == dir) {
      found["uav_agent-" + variable(variables, "SKEIN_UAV")] = std::stoi(pid);
    }
  }
  return found;
}

std::vector<std::string> command_lines_with(const std::string& text) {
  std::vector<std::string> found;
  std::error_code ignored;
  for (fs::directory_iterator it("/proc", ignored), end; it != end; it.increment(ignored)) {
    std::string line = text_of(it->path() / "cmdline");
    std::ranges::replace(line, '\0', ' ');
    if (line.find(text) != std::string::npos) found.push_back(line);
  }
  return found;
}

bool is_flying(const fs::path& dir) {
  constexpr std::uintmax_t kSomeSeconds = 20'000;
  std::error_code missing;
  const std::uintmax_t size = fs::file_size(dir / "trajectories.csv", missing);
  return !missing && size > kSomeSeconds;
}

SkeinRun::SkeinRun(const fs::path& folder, const std::string& name, Arguments arguments, const Environment& environment,
                   const std::string& command)
    : dir_(folder / name) {
  Arguments argv = {program("skein"), command};
  argv.insert(argv.end(), arguments.begin(), arguments.end());
  argv.insert(argv.end(), {"--out", dir_});
  skein_ = std::make_unique<ChildProcess>(argv, environment, folder / (name + ".out"), folder / (name + ".err"));
}

bool SkeinRun::wait_for(const std::string& text) {
  const auto there = [&] { return err().find(text) != std::string::npos; };
  eventually([&] { return there() || skein_->ended(); });
  return there();
}

bool SkeinRun::wait_until_flying() {
  eventually([&] { return is_flying(dir_) || skein_->ended(); });
  return !skein_->ended();
}

std::pair<int, int> SkeinRun::domains() const {
  std::smatch match;
  const std::string text = err();
  if (!std::regex_search(text, match, std::regex(R"(DDS domains (\d+)\.\.(\d+))"))) return {-1, -1};
  return {std::stoi(match[1]), std::stoi(match[2])};
}

std::string SkeinRun::debug_command(const std::string& tool) const {
  const std::string text = err(), gdb = "gdb --args";
  std::smatch match;
  if (!std::regex_search(text, match, std::regex("yourself; [^\n]*\n\n  (.*)\n"))) throw std::runtime_error(text);
  std::string command = "exec env " + match.str(1);
  const std::size_t at = command.find(gdb);
  if (at != std::string::npos) return command.replace(at, gdb.size(), tool);
  return command.insert(command.find("/bin/sh -c"), tool + " ");  // the command of an exec: planner
}

Json SkeinRun::result() const {
  const Json json = Json::parse(text_of(dir_ / "result.json"), nullptr, false);
  if (!json.is_object()) throw std::runtime_error("no result.json in " + dir_.string() + "\n" + err());
  return json;
}

std::string SkeinRun::digest() const {
  const Json digest = result()["digest"];
  return digest.is_string() ? digest.get<std::string>() : "none";
}

FleetTest::FleetTest() : shared_memory_before_(shared_memory()) {
  std::string pattern = fs::path(testing::TempDir()) / "skein_fleet_XXXXXX";
  if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("cannot create " + pattern);
  folder_ = pattern;
}

FleetTest::~FleetTest() {
  programs_.clear();
  runs_.clear();
  if (HasFailure()) {
    std::cerr << "the test's folder is kept: " << folder_.string() << std::endl;
  } else {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
}

fs::path FleetTest::write(const std::string& name, const std::string& text) const {
  fs::create_directories((folder_ / name).parent_path());
  std::ofstream(folder_ / name, std::ios::binary) << text;
  return folder_ / name;
}

SkeinRun& FleetTest::start(const std::string& name, const Arguments& arguments, const Environment& environment,
                           const std::string& command) {
  runs_.push_back(std::make_unique<SkeinRun>(folder_, name, arguments, with_config(environment, folder_), command));
  return *runs_.back();
}

SkeinRun& FleetTest::run(const std::string& name, const Arguments& arguments, const Environment& environment,
                         int exit_code) {
  SkeinRun& run = start(name, arguments, environment);
  EXPECT_EQ(run.exit_code(), exit_code) << run.err();
  return run;
}

ChildProcess& FleetTest::start_program(const std::string& name, const Arguments& argv, const Environment& environment) {
  programs_.push_back(std::make_unique<ChildProcess>(argv, with_config(environment, folder_), folder_ / (name + ".out"),
                                                     folder_ / (name + ".err")));
  return *programs_.back();
}

Arguments FleetTest::installed(const Arguments& words) const {
  Arguments all = {"/usr/bin/env", "-C", folder()};
  for (const char* variable : {"SKEIN", "SKEIN_CONFIG_DIR", "SKEIN_BIN_DIR", "SKEIN_AGENT", "PYTHONPATH"}) {
    all.insert(all.end(), {"-u", variable});
  }
  return joined(std::move(all), words);
}

ChildProcess& FleetTest::skein(const Arguments& arguments) {
  const std::string name = "skein-" + std::to_string(programs_.size());
  ChildProcess& process = start_program(name, joined({program("skein")}, arguments));
  process.wait();
  return process;
}

void FleetTest::expect_nothing_left() {
  for (const auto& run : runs_) {
    if (!run->skein().ended()) continue;  // the test failed half-way; the fixture's destructor ends the run
    std::map<std::string, pid_t> left;
    EXPECT_TRUE(eventually([&] { return (left = processes_of(run->dir())).empty(); }, std::chrono::seconds(20)))
        << left.begin()->first << " is still there";
    const auto [first, last] = run->domains();
    for (int domain = first; domain >= 0 && domain <= last; ++domain) {
      EXPECT_NE(HostLock::holder(domain_lock_name(domain)), run->skein().pid()) << domain;
    }
  }
  std::set<std::string> left;
  const auto nothing_new_is_unused = [&] {
    left = shared_memory();
    std::erase_if(left, [&](const std::string& name) { return shared_memory_before_.contains(name); });
    return (left = unused_shared_memory(left)).empty();
  };
  EXPECT_TRUE(eventually(nothing_new_is_unused, std::chrono::seconds(20))) << *left.begin() << " is left in /dev/shm";
}

void FleetTest::expect_complete_result(const SkeinRun& run) {
  const Json schema = Json::parse(text_of(source_path("docs/result.schema.json")));
  const Json result = run.result();
  for (const std::string& error : schema_errors(result, schema)) ADD_FAILURE() << error;
  EXPECT_EQ(result["uavs"].size() + result["planner"].count("gcs"), result["planner"].size());
  double by_uav = 0.0;
  for (const auto& [uav, score] : result["score_by_uav"].items()) by_uav += score.get<double>();
  if (!result["score"].is_null() && by_uav > 0.0) {
    EXPECT_NEAR(by_uav, result["score"].get<double>(), 1e-9);
  }
  // The losses add up exactly to the attainable score minus the score.
  double lost = 0.0;
  for (const auto& [cause, sum] : result["losses"].items()) lost += sum["score"].get<double>();
  if (!result["losses"].is_null()) {
    EXPECT_EQ(lost, result["attainable"]["score"].get<double>() - result["score"].get<double>());
  }
  if (!result["deterministic"]) {
    EXPECT_TRUE(result["digest"].is_null()) << result["digest"];
  }
  expect_documented_columns(run.dir());
}

}  // namespace skein::test
