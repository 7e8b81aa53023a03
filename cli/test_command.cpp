#include "cli/test_command.hpp"

#include <CLI/CLI.hpp>
#include <map>
#include <thread>

#include "cli/test_counts.hpp"
#include "cli/test_folders.hpp"
#include "core/types.hpp"
#include "host/preflight.hpp"
#include "process/host/environment.hpp"
#include "process/program.hpp"
#include "run/fleet_plan.hpp"

namespace skein::cli {

void add_test(CLI::App& app, TestOptions& test) {
  CLI::App* command =
      app.add_subcommand("test", "Run the test suite, or your fault tests; the last line is 'N passed, N failed'");
  command->add_flag("--long", test.long_tests,
                    "Include the tests that take minutes; with --faults: do all repetitions of --repeat for each test");
  CLI::Option* faults =
      command->add_option("--faults", test.faults, "A fault test (YAML) or a folder of them, instead of the suite");
  command->add_option("FOLDER", test.folders, "Only the tests in these folders of the source tree, and below")
      ->excludes(faults);
  command
      ->add_option("--repeat", test.repeat,
                   "Also fly each fault test in these ways and compare the digests: again, cyclonedds, fastdds, mixed, "
                   "chaos, one_process")
      ->delimiter(',')
      ->check(CLI::IsMember({"again", "cyclonedds", "fastdds", "mixed", "chaos", "one_process"}))
      ->needs(faults);
  command->add_flag("--rotate", test.rotate, "Do only one of the repetitions for each test, in turn")
      ->needs("--repeat");
  command->add_option("--out", test.out, "Folder of the fault tests' results")->needs(faults)->capture_default_str();
  command
      ->add_option("--assets", test.assets,
                   "Folder of data files (with models/) for scenarios that need them, such as mbs")
      ->needs(faults);
  command->add_option("--agent", test.agent, "Agent program with planners of your own, as for `skein run`")
      ->needs(faults);
  command
      ->add_flag("--one-process", test.one_process, "Fly in one process, without DDS, except for repetitions over DDS")
      ->needs(faults);
  command->add_option("--seeds", test.seeds, "Fly each fault test with each of these seeds: 1-20, 3,5,8 or 7")
      ->needs(faults);
  command->add_option("--jobs", test.jobs, "Number of simultaneous flights; results do not depend on it")
      ->needs(faults)
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  command->add_option("--junit", test.junit, "File for a report as JUnit XML, for CI servers")->needs(faults);
  command->add_flag("-v,--verbose", test.verbose, "Also print the observed values of expectations that hold")
      ->needs(faults);
  command->footer(
      "Examples:\n"
      "  skein test\n"
      "  skein test sim_server tests/fleet\n"
      "  skein test --faults config/faults/station_outage.yaml -v\n"
      "  skein test --faults my_tests --agent build/my_agent --seeds 1-20 --jobs 2 --junit faults.xml\n\n"
      "A fault test is described in docs/how-to-test-faults.md; config/faults/ has examples.\n"
      "Exit codes: 0 all passed, 1 one failed, 2 a file is wrong.");
}

int run_tests(const TestOptions& options, const Console& console) {
  if (options.faults) return run_fault_tests(options, console);
  const ScratchDir scratch;
  const std::filesystem::path build_dir = std::filesystem::absolute(program_dir()).parent_path();
  if (!std::filesystem::exists(build_dir / "CTestTestfile.cmake")) {
    throw InputError("test: this skein has no tests beside it; ./skein test in the source tree builds and runs them");
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
