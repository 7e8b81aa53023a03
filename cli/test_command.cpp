#include "cli/actions.hpp"

#include <thread>

#include "cli/test_counts.hpp"
#include "cli/test_folders.hpp"
#include "host/preflight.hpp"
#include "process/host/environment.hpp"
#include "process/program.hpp"
#include "run/fleet_plan.hpp"

namespace skein::cli {

int run_tests(const TestOptions& options, const Console& console) {
  if (options.faults) return run_fault_tests(options, console);
  const ScratchDir scratch;
  const std::filesystem::path build_dir = std::filesystem::absolute(program_dir()).parent_path();
  if (!std::filesystem::exists(build_dir / "CTestTestfile.cmake")) {
    throw InputError(
        "test: there are no tests beside this skein; ./skein test in the source tree builds and runs them");
  }
  const std::filesystem::path junit = scratch.path() / "ctest.xml", reports = scratch.path() / "gtest";
  // One job more than there are cores, since tests often wait for their processes.
  std::vector<std::string> words = {
      "/usr/bin/env",        "ctest",
      "--test-dir",          build_dir,
      "--no-label-summary",  "-j" + std::to_string(std::thread::hardware_concurrency() + 1),
      "--output-on-failure", "--no-tests=error",
      "--output-junit",      junit};
  if (!options.folders.empty()) {
    words.insert(words.end(), {"--label-regex", labels_of_folders(options.folders, build_dir / "test_folders.txt")});
  }
  std::map<std::string, std::string> variables = {{"GTEST_OUTPUT", "json:" + reports.string() + "/"}};
  if (options.long_tests) variables["SKEIN_LONG"] = "1";
  const ExitStatus exit = run_to_end({"ctest", words, environment_with(variables), {}});
  TestCounts counts = count_tests(junit, reports);
  if (!exit.ok() && counts.failed == 0) counts.failed = 1;  // ctest itself failed
  console.out << parts_table(junit, 20) << summary_line(counts) << std::endl;
  return counts.failed == 0 ? kExitDone : kExitCheckFailed;
}

}  // namespace skein::cli
