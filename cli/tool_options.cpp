#include "cli/tool_options.hpp"

#include <CLI/CLI.hpp>

#include "cli/option_checks.hpp"
#include "core/text/number_checks.hpp"

namespace skein::cli {
namespace {

/// Refuses the options that only `skein doctor net` uses. @throws InputError
void check_doctor(const DoctorOptions& doctor) {
  if (doctor.net) return;
  const auto refuse = [](bool given, const std::string& option) {
    if (given) throw InputError(option + ": only `skein doctor net` takes this option");
  };
  refuse(doctor.name.has_value(), "--as");
  refuse(!doctor.only.empty(), "--only");
  refuse(doctor.seconds.has_value(), "--seconds");
}

}  // namespace

void add_doctor(CLI::App& app, DoctorOptions& doctor) {
  CLI::App* command = app.add_subcommand(
      "doctor", "Find problems of this machine or network that would disturb a fleet, and how to fix them");
  const auto set_net = [&doctor](const std::string&) { doctor.net = true; };
  command
      ->add_option_function<std::string>(
          "WHAT", set_net,
          "net: test which hosts receive each other's messages; run this command on all of them at the same time")
      ->check(CLI::IsMember({"net"}));
  add_network(*command, doctor.network);
  command
      ->add_option("--scenario", doctor.scenario,
                   "Scenario of the fleet: a name under config/scenarios/ or a YAML file")
      ->capture_default_str();
  command->add_option("--assets", doctor.assets,
                      "Folder of data files (with models/) for scenarios that need them, such as mbs");
  command->add_option("--domain", doctor.domain, "First DDS domain of the fleet");
  command->add_option("--dds", doctor.dds, "DDS vendor: cyclonedds, fastdds or mixed")
      ->check(CLI::IsMember({"cyclonedds", "fastdds", "mixed"}))
      ->capture_default_str();
  command->add_option("--out", doctor.out, "Folder for results, to check that a run can write there")
      ->capture_default_str();
  command->add_flag("--json", doctor.json, "Print JSON, for programs");
  command->add_option("--as", doctor.name, "net: name under which this host reports (default: its host name)");
  command
      ->add_option(
          "--only", doctor.only,
          "net: domains in which this host takes part: world,gcs,UAV,... (default: all domains that leave the host)")
      ->delimiter(',');
  command->add_option("--seconds", doctor.seconds, "net: how long to send and receive [s] (default 5)")
      ->check(CLI::Validator(check_seconds, ""));
  command->callback([&doctor] { check_doctor(doctor); });
  command->footer(
      "Examples:\n"
      "  skein doctor --scenario towers\n"
      "  skein doctor net --network network.yaml --only world,gcs --seconds 30\n\n"
      "Exit codes: 0 all checks pass, 1 a check fails, or no message of a peer arrived. See docs/doctor.md.");
}

void add_attach(CLI::App& app, AttachOptions& attach) {
  CLI::App* command =
      app.add_subcommand("attach", "Attach a debugger to one program of a flying fleet; the fleet waits meanwhile");
  command
      ->add_option("UAV", attach.what,
                   "UAV, gcs, sim_server, comm_router or station. TOOL: gdb (default), gdbserver:PORT, or a command "
                   "that takes a process id as its last argument")
      ->required()
      ->type_name("UAV[=TOOL]");
  command->add_option("--run", attach.run, "Results folder of the fleet (default: the only fleet that flies)");
  command->footer(
      "Examples:\n"
      "  skein attach jurong\n"
      "  skein attach jurong='strace -f -p' --run runs/towers-kios-0\n\n"
      "`skein ps` lists the fleets that fly. See docs/how-to-debug.md.");
}

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

void add_check(CLI::App& app, CheckOptions& check) {
  CLI::App* command = app.add_subcommand(
      "check", "Check scenarios, vehicles, fault files and fault tests, or compare reference vectors with the code");
  command->add_option("FILE", check.files, "YAML files of these kinds");
  command->add_option("--golden", check.golden, "Compare these reference vectors (CSV) with what the code computes");
  command->add_option("--assets", check.assets,
                      "Folder of data files (with models/) for scenarios that need them, such as mbs");
  command->add_option("--agent", check.agent,
                      "Agent program with planners of your own (default: SKEIN_AGENT, else uav_agent)");
  command->add_option("--scenario", check.scenario, "Scenario of fault files that do not name one")
      ->capture_default_str();
  command->add_option("--conditions", check.conditions,
                      "Conditions of fault files that do not name a scenario: none, breezy, harsh, ...");
  command->footer(
      "Examples:\n"
      "  skein check my_scenario.yaml my_vehicle.yaml my_faults.yaml\n"
      "  skein check my_faults.yaml --scenario cranes");
}

void finish_check(CheckOptions& check, const std::vector<std::string>& /*arguments*/) {
  if (check.files.empty() && check.golden.empty()) throw InputError("check: give files, or --golden FILE.csv");
}

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

void add_scene(CLI::App& app, SceneOptions& scene) {
  CLI::App* command = app.add_subcommand("scene", "Write a scene as STL, PCD and boxes, with a scenario that flies it");
  command->add_option("SCENARIO", scene.scenario, "A name under config/scenarios/ or a YAML file")->required();
  command->add_option("--scene-seed", scene.scene_seed, "Number of the variant of a procedural scenario")
      ->check(CLI::Validator(check_seed, ""));
  command->add_option("--out", scene.out, "Folder to write to");
  command->add_flag("--picture", scene.picture,
                    "Draw the scene as SCENARIO.svg, in the folder of --out or the current one");
  command->add_option("--assets", scene.assets,
                      "Folder of data files (with models/) for scenarios that need them, such as mbs");
  command->add_flag("--force", scene.force, "Overwrite an earlier export");
  command->callback([&scene] {
    if (!scene.out && !scene.picture) {
      throw InputError("scene: give --out FOLDER to write the scene, --picture to draw it, or both");
    }
  });
  command->footer(
      "Examples:\n"
      "  skein scene towers --scene-seed 3 --out my_scene\n"
      "  skein scene wild --scene-seed 7 --picture");
}

void add_report(CLI::App& app, ReportOptions& report) {
  CLI::App* command = app.add_subcommand("report", "Write report.html of finished runs again");
  command->add_option("RUN", report.runs, "Results folders")->required();
  command->footer("Example:\n  skein report runs/towers-kios-0\n\nSee docs/report.md.");
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

void add_oracle(CLI::App& app, OracleOptions& oracle) {
  CLI::App* command =
      app.add_subcommand("oracle", "Compute the score that is attainable with full knowledge of the scene");
  command->add_option("SCENARIO", oracle.scenario, "A name under config/scenarios/ or a YAML file")->required();
  command->add_option("--scene-seed", oracle.scene_seed, "Number of the variant of a procedural scenario")
      ->check(CLI::Validator(check_seed, ""));
  command->add_option("--assets", oracle.assets,
                      "Folder of data files (with models/) for scenarios that need them, such as mbs");
  command->add_option("--rules", oracle.rules,
                      "Preset of rules, instead of the scenario's: contest, paper or reference");
  command
      ->add_option("--clearance", oracle.clearances_m,
                   "Least distance of the cameras from the structure [m] (default 0.5); several values, such as "
                   "0.5,0.8,1.2, give a table")
      ->delimiter(',')
      ->check(CLI::Validator(number_within(0.0, 100.0), ""));
  command->add_flag(
      "--vehicle", oracle.vehicle,
      "Apply the clearance to a sphere around body and rotors, not to the camera (default of --clearance then 0)");
  command->add_flag("--outside", oracle.outside_only,
                    "Count only what is attainable from outside the structure, not through windows");
  command->add_flag("--plan", oracle.plan,
                    "Also compute what this fleet could score in the mission's time with full knowledge: a lower bound "
                    "found by search, which Skein flies once as proof");
  command->add_flag("--json", oracle.json, "Print all figures as JSON, for programs");
  command->footer("Example:\n  skein oracle towers --clearance 0.5,0.8,1.2");
}

void add_merge(CLI::App& app, MergeOptions& merge) {
  CLI::App* command =
      app.add_subcommand("merge", "Make result.json from the reports of programs that ran without the launcher");
  command->add_option("DIR", merge.dir, "Folder with the reports")->required();
  command->add_option("--scenario", merge.scenario,
                      "Scenario that was flown, if the name in the server's report is unknown on this host");
  command->add_option("--assets", merge.assets,
                      "Folder of data files (with models/) for scenarios that need them, such as mbs");
  command->add_flag("--no-report{false}", merge.report, "Do not write report.html");
  command->footer("Example:\n  skein merge results");
}

void add_ps(CLI::App& app, PsOptions& /*none*/) {
  app.add_subcommand("ps", "List the fleets that fly now, with their processes");
}

void add_diff(CLI::App& app, DiffOptions& diff) {
  CLI::App* command = app.add_subcommand(
      "diff", "Show the first step, entity and field in which two runs differ, and which of their files differ");
  command->add_option("RUN_A", diff.run_a, "Results folder")->required();
  command->add_option("RUN_B", diff.run_b, "Results folder to compare with it")->required();
  command->footer("Example:\n  skein diff runs/towers-kios-0 runs/again");
}

}  // namespace skein::cli
