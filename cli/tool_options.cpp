#include "cli/tool_options.hpp"

#include <CLI/CLI.hpp>

#include "cli/option_checks.hpp"

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

void add_bench(CLI::App& app, BenchOptions& bench) {
  CLI::App* command = app.add_subcommand("bench", "Measure speed, scale and memory on this machine");
  command->add_flag("--quick", bench.quick, "Measure less of everything, in less than a minute");
  command->add_flag("--hour", bench.hour,
                    "Also measure memory over an hour of simulated time; takes some minutes more");
  command->add_option("--scenario", bench.scenarios,
                      "Scenarios of the speed runs (default: towers; mbs with --assets)");
  command->add_option("--assets", bench.assets,
                      "Folder of data files (with models/) for scenarios that need them, such as mbs");
  command->add_option("--dds", bench.dds, "DDS vendor: cyclonedds or fastdds")
      ->check(CLI::IsMember({"cyclonedds", "fastdds"}))
      ->capture_default_str();
  command->add_option("--sizes", bench.sizes, "Fleet sizes, such as 1,5,20")->delimiter(',')->check(CLI::Range(1, 128));
  command->add_option("--repeat", bench.repeats, "Runs of each kind; medians are reported")->check(CLI::Range(1, 100));
  command
      ->add_option("--duration", bench.duration_s,
                   "Mission time of the speed runs, or of --tracking, --view or --python [s], instead of the usual one")
      ->check(CLI::Validator(check_seconds, ""));
  command->add_option("--json", bench.json, "File for all figures");
  CLI::Option* planners =
      command->add_flag("--planners", bench.planners,
                        "Measure the scores of all planners in a fixed set of scenes, and compare them with a table");
  command->add_option("--against", bench.against, "Table to compare with (default: config/planner_scores.csv)")
      ->needs(planners);
  CLI::Option* sensing =
      command
          ->add_flag("--sensing", bench.sensing,
                     "Measure what an explorer knows of the space around it: the tables of docs/sensing.md")
          ->excludes(planners);
  CLI::Option* tracking = command
                              ->add_flag("--tracking", bench.tracking,
                                         "Measure how far UAVs are from their setpoints, by speed and acceleration: "
                                         "the table of docs/flight-safety.md")
                              ->excludes(planners)
                              ->excludes(sensing);
  command
      ->add_flag("--view", bench.view,
                 "Measure what the live page costs the fleet, and what the page itself needs; needs Chromium and a "
                 "source tree")
      ->excludes(planners)
      ->excludes(sensing)
      ->excludes(tracking);
  CLI::Option* profile = command
                             ->add_flag("--profile", bench.profile,
                                        "Measure the CPU time of an exchange by stage and planner for each fleet size "
                                        "(--sizes), and its growth; in one process")
                             ->excludes(planners)
                             ->excludes(sensing)
                             ->excludes(tracking);
  command
      ->add_flag("--python", bench.python,
                 "Measure what planners in Python cost compared with C++, and what stepping, resetting and copying a "
                 "fleet cost; needs a source tree")
      ->excludes(planners)
      ->excludes(sensing)
      ->excludes(tracking)
      ->excludes(profile);
  command
      ->add_option("--write", bench.write,
                   "File for the new table of --planners; folder for pictures and page of --sensing")
      ->each([planners, sensing](const std::string&) {
        if (planners->empty() && sensing->empty()) throw CLI::RequiresError("--write", "--planners or --sensing");
      });
  command->footer(
      "Examples:\n  skein bench --quick --json bench.json\n  skein bench --planners --write scores.csv\n"
      "  skein bench --sensing --write docs\n  skein bench --tracking --quick\n  skein bench --view\n"
      "  skein bench --profile --sizes 1,5,20\n  skein bench --python --assets DIR");
}

}  // namespace skein::cli
