// What the fleet tests share: the built `skein`, driven as a user would, and what is to be seen of a run from outside.
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

/// True when the environment asks for the tests that take minutes.
bool long_tests();

/// Path of a built program.
std::string program(const std::string& name);

/// Of a file that somebody still writes, the last line may lack its end: it is left out.
enum class LastLine { whole, may_be_unfinished };

/// Every row of a CSV file with a header, by column.
std::vector<std::map<std::string, std::string>> read_csv(const std::filesystem::path& file,
                                                         LastLine last = LastLine::whole);

/// Processes that were started with `--out dir`, or as a user's command with SKEIN_OUT=dir, by the names that Skein's
/// messages give them.
std::map<std::string, pid_t> processes_of(const std::filesystem::path& dir);

/// True once the server has written some simulated seconds of trajectories: it writes them in blocks.
bool is_flying(const std::filesystem::path& dir);

/// A `skein run`, or `skein compose --up`, from its start on.
class SkeinRun {
 public:
  /// @param folder  of the test; the results go to `folder`/`name`. @param command  of `skein`: "run" or "compose"
  SkeinRun(const std::filesystem::path& folder, const std::string& name, Arguments arguments,
           const Environment& environment = {}, const std::string& command = "run");

  ChildProcess& skein() { return *skein_; }
  const std::filesystem::path& dir() const { return dir_; }
  std::string err() const { return skein_->err(); }
  std::string out() const { return skein_->out(); }
  int exit_code() { return skein_->wait().code; }
  /// Waits until the launcher's stderr holds `text` or the launcher has ended. @returns whether it does.
  bool wait_for(const std::string& text);
  /// Waits until the run has gone on for some simulated seconds. @returns false when it has ended before.
  bool wait_until_flying();
  /// First and last DDS domain, as the launcher tells them.
  std::pair<int, int> domains() const;
  /// Of `--debug UAV`, for a shell: what the launcher tells its user to start. @param tool  in the place of gdb
  std::string debug_command(const std::string& tool = {}) const;
  Json result() const;
  std::string digest() const;

 private:
  std::filesystem::path dir_;
  std::unique_ptr<ChildProcess> skein_;
};

/// A folder for each test, removed after a test that passed. At the end of each test nothing of it may be left.
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
  /// Starts and waits; the launcher must end with `exit_code`.
  SkeinRun& run(const std::string& name, const Arguments& arguments, const Environment& environment = {},
                int exit_code = 0);
  /// Starts any other program.
  ChildProcess& start_program(const std::string& name, const Arguments& argv, const Environment& environment = {});
  /// The command line of an installed or packed program, in the test's folder: nothing leads it to this build.
  /// @param words  variables first, if any: "PYTHONPATH=...".
  Arguments installed(const Arguments& words) const;
  /// `skein diff`, and similar: @returns the process after its end.
  ChildProcess& skein(const Arguments& arguments);

  /// No process of a run of this test, no lock on a DDS domain, and no shared memory that nobody uses: what other tests
  /// use meanwhile is theirs.
  void expect_nothing_left();

  /// Everything that docs/results.md promises of any run, also of one that failed.
  static void expect_complete_result(const SkeinRun& run);

 private:
  std::filesystem::path folder_;
  std::set<std::string> shared_memory_before_;
  std::vector<std::unique_ptr<SkeinRun>> runs_;
  std::vector<std::unique_ptr<ChildProcess>> programs_;
};

}  // namespace skein::test
