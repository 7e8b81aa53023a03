// Fixture of the fleet tests: runs the built `skein` as a user would, and observes a run from outside.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "child_process.hpp"

namespace skein::test {

using Json = nlohmann::json;

/// The fleet of the bundled scenario, in its order.
inline const std::vector<std::string> kFleet = {"jurong", "raffles", "sentosa", "changi", "nanyang"};
inline const std::vector<std::string> kPrograms = {"sim_server",       "comm_router",       "station",
                                                   "uav_agent-jurong", "uav_agent-raffles", "uav_agent-sentosa",
                                                   "uav_agent-changi", "uav_agent-nanyang"};

/// Whether to run the tests that take minutes: SKEIN_LONG is set.
bool long_tests();

/// Path of a built program.
std::string program(const std::string& name);

/// may_be_unfinished: a program still writes the file, so read_csv() leaves out a last line without a line break.
enum class LastLine { whole, may_be_unfinished };

/// Every row of a CSV file with a header, by column.
std::vector<std::map<std::string, std::string>> read_csv(const std::filesystem::path& file,
                                                         LastLine last = LastLine::whole);

/// The processes of a fleet, by their names in Skein's messages: those with `--out dir` in their command line, and
/// user's commands with SKEIN_OUT=dir in their environment.
std::map<std::string, pid_t> processes_of(const std::filesystem::path& dir);
/// The command lines of all processes that contain a text, such as the path of a test's folder.
std::vector<std::string> command_lines_with(const std::string& text);

/// True once the server has written some simulated seconds of trajectories: it writes them in blocks.
bool is_flying(const std::filesystem::path& dir);

/// A `skein run` or `skein compose --up` that has been started.
class SkeinRun {
 public:
  /// @param folder  the test's folder; the results go to `folder`/`name`. @param command  "run" or "compose"
  SkeinRun(const std::filesystem::path& folder, const std::string& name, Arguments arguments,
           const Environment& environment = {}, const std::string& command = "run");

  ChildProcess& skein() { return *skein_; }
  const std::filesystem::path& dir() const { return dir_; }
  std::string err() const { return skein_->err(); }
  std::string out() const { return skein_->out(); }
  int exit_code() { return skein_->wait().code; }
  /// Waits until the launcher's stderr holds `text` or the launcher has ended. @returns whether stderr holds it.
  bool wait_for(const std::string& text);
  /// Waits until the run has flown for some simulated seconds. @returns false when the launcher has ended.
  bool wait_until_flying();
  /// First and last DDS domain, as the launcher prints them; -1 if it has not.
  std::pair<int, int> domains() const;
  /// With `--debug UAV`: the shell command that the launcher asks its user to start. @param tool  replaces `gdb --args`
  std::string debug_command(const std::string& tool = {}) const;
  Json result() const;
  std::string digest() const;

 private:
  std::filesystem::path dir_;
  std::unique_ptr<ChildProcess> skein_;
};

/// Gives each test a folder, which is removed if the test passes. After each test it checks that the test has left
/// nothing else behind.
class FleetTest : public testing::Test {
 protected:
  FleetTest();
  ~FleetTest() override;
  void TearDown() override {
    programs_.clear();
    expect_nothing_left();
  }

  const std::filesystem::path& folder() const { return folder_; }
  std::filesystem::path write(const std::string& name, const std::string& text) const;

  SkeinRun& start(const std::string& name, const Arguments& arguments, const Environment& environment = {},
                  const std::string& command = "run");
  /// Starts a run and waits for its end; the launcher must exit with `exit_code`.
  SkeinRun& run(const std::string& name, const Arguments& arguments, const Environment& environment = {},
                int exit_code = 0);
  /// Starts any other program.
  ChildProcess& start_program(const std::string& name, const Arguments& argv, const Environment& environment = {});
  /// The command line that runs an installed or packed program in the test's folder, without the variables that would
  /// lead it to this build. @param words  the command line, after variables if any: "PYTHONPATH=...".
  Arguments installed(const Arguments& words) const;
  /// Runs `skein ARGUMENTS...` (`skein diff` for example). @returns the process after its end.
  ChildProcess& skein(const Arguments& arguments);

  /// Expects that this test's runs have left no process, no lock on a DDS domain, and no unused shared memory. Shared
  /// memory in use may belong to other tests.
  void expect_nothing_left();

  /// Expects the files and keys that docs/results.md promises for every run, even a failed one.
  static void expect_complete_result(const SkeinRun& run);

 private:
  std::filesystem::path folder_;
  std::set<std::string> shared_memory_before_;
  std::vector<std::unique_ptr<SkeinRun>> runs_;
  std::vector<std::unique_ptr<ChildProcess>> programs_;
};

}  // namespace skein::test
