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
    if (given) throw InputError(option + ": only `skein doctor net` has a use for it");
  };
  refuse(doctor.name.has_value(), "--as");
  refuse(!doctor.only.empty(), "--only");
  refuse(doctor.seconds.has_value(), "--seconds");
}

}  // namespace

void add_doctor(CLI::App& app, DoctorOptions& doctor) {
  CLI::App* command =
      app.add_subcommand("doctor", "Find what on this machine or network would disturb a fleet, and how to fix it");
  const auto set_net = [&doctor](const std::string&) { doctor.net = true; };
  command
      ->add_option_function<std::string>("WHAT", set_net,
                                         "net: who hears whom, among the hosts on which this runs at the same time")
      ->check(CLI::IsMember({"net"}));
  add_network(*command, doctor.network);
  command->add_option("--scenario", doctor.scenario, "Whose fleet: a name under config/scenarios/ or a YAML file")
      ->capture_default_str();
  command->add_option("--assets", doctor.assets, "Folder with models/ for scenarios that read files");
  command->add_option("--domain", doctor.domain, "First DDS domain of the fleet");
  command->add_option("--dds", doctor.dds, "DDS vendor: cyclonedds, fastdds or mixed")
      ->check(CLI::IsMember({"cyclonedds", "fastdds", "mixed"}))
      ->capture_default_str();
  command->add_option("--out", doctor.out, "Where results would go")->capture_default_str();
  command->add_flag("--json", doctor.json, "For programs");
  command->add_option("--as", doctor.name, "net: name of this host (default: its own)");
  command
      ->add_option("--only", doctor.only,
                   "net: domains in which this host takes part: world,gcs,UAV,... (default: all that leave it)")
      ->delimiter(',');
  command->add_option("--seconds", doctor.seconds, "net: how long to speak and listen [s] (default 5)")
      ->check(CLI::Validator(check_seconds, ""));
  command->callback([&doctor] { check_doctor(doctor); });
  command->footer(
      "Examples:\n"
      "  skein doctor --scenario towers\n"
      "  skein doctor net --network network.yaml --only world,gcs --seconds 30\n\n"
      "Exit codes: 0 nothing fails, 1 something does, or a peer was not heard. docs/doctor.md has more.");
}

void add_attach(CLI::App& app, AttachOptions& attach) {
  CLI::App* command = app.add_subcommand("attach", "Debug one program of a fleet that is flying, which then waits");
  command
      ->add_option("UAV", attach.what,
                   "A UAV, gcs, sim_server, comm_router or station; with =gdb (default), =gdbserver:PORT, or =CMD, a "
                   "tool that takes a process id as its last word")
      ->required()
      ->type_name("UAV[=TOOL]");
  command->add_option("--run", attach.run, "Results folder of its fleet (default: the only one that flies)");
  command->footer(
      "Examples:\n"
      "  skein attach jurong\n"
      "  skein attach jurong='strace -f -p' --run runs/towers-kios-0\n\n"
      "`skein ps` lists the fleets that fly. docs/how-to-debug.md has more.");
}

void add_test(CLI::App& app, TestOptions& test) {
  CLI::App* command =
      app.add_subcommand("test", "Run the test suite, or your fault tests; the last line is 'N passed, N failed'");
  command->add_flag("--long", test.long_tests,
                    "Include the tests that take minutes; with --faults: repeat each in every way");
  CLI::Option* faults =
      command->add_option("--faults", test.faults, "A fault test (YAML) or a folder of them, instead of the suite");
  command->add_option("FOLDER", test.folders, "Only the tests in these folders of the source tree, and below")
      ->excludes(faults);
  command
      ->add_option(
          "--repeat", test.repeat,
          "Fly each fault test again and compare digests: again, cyclonedds, fastdds, mixed, chaos, one_process")
      ->delimiter(',')
      ->check(CLI::IsMember({"again", "cyclonedds", "fastdds", "mixed", "chaos", "one_process"}))
      ->needs(faults);
  command->add_flag("--rotate", test.rotate, "Only one of the repetitions a test, in turn")->needs("--repeat");
  command->add_option("--out", test.out, "Folder of the fault tests' results")->needs(faults)->capture_default_str();
  command->add_option("--assets", test.assets, "Folder with models/ for scenarios that read files")->needs(faults);
  command->add_option("--agent", test.agent, "Agent program with planners of your own, as for `skein run`")
      ->needs(faults);
  command
      ->add_flag("--one-process", test.one_process, "Fly in one process, without DDS, what no repetition does over it")
      ->needs(faults);
  command->add_option("--seeds", test.seeds, "Fly each fault test with each of these seeds: 1-20, 3,5,8 or 7")
      ->needs(faults);
  command->add_option("--jobs", test.jobs, "Flights at once; results do not depend on it")
      ->needs(faults)
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  command->add_option("--junit", test.junit, "File for a report as JUnit XML, as CI servers read it")->needs(faults);
  command->add_flag("-v,--verbose", test.verbose, "Tell what was seen where something holds, too")->needs(faults);
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
  CLI::App* command =
      app.add_subcommand("check", "Validate scenarios, vehicles, fault files and fault tests, or reference vectors");
  command->add_option("FILE", check.files, "YAML files of any of these kinds");
  command->add_option("--golden", check.golden, "Run reference vectors (CSV) through the production code");
  command->add_option("--assets", check.assets, "Folder with models/ for scenarios that read files");
  command->add_option("--agent", check.agent,
                      "Agent program with planners of your own (default: SKEIN_AGENT, else uav_agent)");
  command->add_option("--scenario", check.scenario, "What fault files are for that name no scenario themselves")
      ->capture_default_str();
  command->add_option("--conditions", check.conditions,
                      "Conditions that such fault files are for: none, breezy, harsh, ...");
  command->footer(
      "Examples:\n"
      "  skein check my_scenario.yaml my_vehicle.yaml my_faults.yaml\n"
      "  skein check my_faults.yaml --scenario cranes");
}

void add_convert(CLI::App& app, ConvertOptions& convert) {
  CLI::App* command = app.add_subcommand("convert", "Turn fault tests of earlier versions into those of this one");
  command->add_option("FILE", convert.files, "A fault test, or a folder of them")->required();
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
  command->add_option("--scene-seed", scene.scene_seed, "Which scene of a procedural family")
      ->check(CLI::Validator(check_seed, ""));
  command->add_option("--out", scene.out, "Folder to write to");
  command->add_flag("--picture", scene.picture, "Draw it: SCENARIO.svg, in that folder or the current one");
  command->add_option("--assets", scene.assets, "Folder with models/ for scenarios that read files");
  command->add_flag("--force", scene.force, "Overwrite an earlier export");
  command->callback([&scene] {
    if (!scene.out && !scene.picture) throw InputError("scene: --out FOLDER writes it, --picture draws it: which?");
  });
  command->footer(
      "Examples:\n"
      "  skein scene towers --scene-seed 3 --out my_scene\n"
      "  skein scene wild --scene-seed 7 --picture");
}

void add_report(CLI::App& app, ReportOptions& report) {
  CLI::App* command = app.add_subcommand("report", "Make report.html of finished runs again");
  command->add_option("RUN", report.runs, "Results folders")->required();
  command->footer("Example:\n  skein report runs/towers-kios-0\n\ndocs/report.md tells what the page shows.");
}

void add_bench(CLI::App& app, BenchOptions& bench) {
  CLI::App* command = app.add_subcommand("bench", "Measure speed, scale and memory on this machine");
  command->add_flag("--quick", bench.quick, "Less of everything: a first impression in less than a minute");
  command->add_flag("--hour", bench.hour, "Memory over an hour of simulated time too: minutes more");
  command->add_option("--scenario", bench.scenarios,
                      "Scenarios of the speed runs (default: towers; mbs with --assets)");
  command->add_option("--assets", bench.assets, "Folder with models/ for scenarios that read files");
  command->add_option("--dds", bench.dds, "DDS vendor: cyclonedds or fastdds")
      ->check(CLI::IsMember({"cyclonedds", "fastdds"}))
      ->capture_default_str();
  command->add_option("--sizes", bench.sizes, "Sizes of fleet, as 1,5,20")->delimiter(',')->check(CLI::Range(1, 128));
  command->add_option("--repeat", bench.repeats, "Runs of each kind; medians are reported")->check(CLI::Range(1, 100));
  command
      ->add_option("--duration", bench.duration_s,
                   "Mission time of the speed runs, or of --tracking, --view or --python [s], instead of the usual one")
      ->check(CLI::Validator(check_seconds, ""));
  command->add_option("--json", bench.json, "File for all figures");
  CLI::Option* planners = command->add_flag("--planners", bench.planners,
                                            "Scores of all planners in a fixed set of scenes beside those of a table");
  command->add_option("--against", bench.against, "Another table than config/planner_scores.csv")->needs(planners);
  CLI::Option* sensing = command
                             ->add_flag("--sensing", bench.sensing,
                                        "What an explorer knows of the space around it: the tables of docs/sensing.md")
                             ->excludes(planners);
  CLI::Option* tracking =
      command
          ->add_flag(
              "--tracking", bench.tracking,
              "How far UAVs are from their set-points by speed and acceleration: the table of docs/flight-safety.md")
          ->excludes(planners)
          ->excludes(sensing);
  command
      ->add_flag("--view", bench.view,
                 "What a page costs that follows a run, and what it takes itself; needs Chromium and a source tree")
      ->excludes(planners)
      ->excludes(sensing)
      ->excludes(tracking);
  CLI::Option* profile =
      command
          ->add_flag("--profile", bench.profile,
                     "CPU time of an exchange by stage and planner over --sizes, and how each grows; in one process")
          ->excludes(planners)
          ->excludes(sensing)
          ->excludes(tracking);
  command
      ->add_flag("--python", bench.python,
                 "What planners in Python cost beside C++, and fleets that Python steps, resets and copies; needs a "
                 "source tree")
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
  CLI::App* command = app.add_subcommand("oracle", "The score that is attainable with full knowledge of the scene");
  command->add_option("SCENARIO", oracle.scenario, "A name under config/scenarios/ or a YAML file")->required();
  command->add_option("--scene-seed", oracle.scene_seed, "Which scene of a procedural family")
      ->check(CLI::Validator(check_seed, ""));
  command->add_option("--assets", oracle.assets, "Folder with models/ for scenarios that read files");
  command->add_option("--rules", oracle.rules,
                      "Preset of rules, instead of the scenario's: contest, paper or reference");
  command
      ->add_option("--clearance", oracle.clearances_m,
                   "Of the cameras from the structure [m] (default 0.5); several as 0.5,0.8,1.2 make a table")
      ->delimiter(',')
      ->check(CLI::Validator(number_within(0.0, 100.0), ""));
  command->add_flag("--vehicle", oracle.vehicle,
                    "A sphere about body and rotors keeps the clearance (default then 0), not the camera");
  command->add_flag("--outside", oracle.outside_only, "Only what is attainable from outside, not through windows");
  command->add_flag("--plan", oracle.plan,
                    "What full knowledge scores in the mission's time with this fleet, too: a lower bound found by "
                    "search, flown once to show that it can be");
  command->add_flag("--json", oracle.json, "All figures, for programs");
  command->footer("Example:\n  skein oracle towers --clearance 0.5,0.8,1.2");
}

void add_merge(CLI::App& app, MergeOptions& merge) {
  CLI::App* command =
      app.add_subcommand("merge", "Make result.json of what programs left that ran without the launcher");
  command->add_option("DIR", merge.dir, "Folder with their reports")->required();
  command->add_option("--scenario", merge.scenario,
                      "What was flown, if the server's own word for it is not known here");
  command->add_option("--assets", merge.assets, "Folder with models/ for scenarios that read files");
  command->add_flag("--no-report{false}", merge.report, "Make no report.html");
  command->footer("Example:\n  skein merge results");
}

}  // namespace skein::cli
