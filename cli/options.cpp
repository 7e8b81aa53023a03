#include "cli/options.hpp"

#include <CLI/CLI.hpp>

#include "cli/option_checks.hpp"
#include "core/types.hpp"

#ifndef SKEIN_VERSION
#error "SKEIN_VERSION comes from CMake's project()"
#endif

namespace skein::cli {
namespace {

/// Of run, compare and contest.
void add_network(CLI::App& command, std::optional<std::string>& network) {
  command
      .add_option(
          "--network", network,
          "Let other hosts take part, by this network interface, all, or domain by domain: a YAML file, or its text "
          "in braces (default: nothing leaves this host)")
      ->envname("SKEIN_NETWORK")
      ->type_name("[IFACE|all|FILE]")
      ->expected(0, 1)
      ->default_str("all");
}

CLI::App* add_run(CLI::App& app, RunOptions& run) {
  CLI::App* command = app.add_subcommand("run", "Fly a fleet through a scenario and write its results");
  command->add_option("SCENARIO", run.scenario, "A name under config/scenarios/ or a YAML file")->capture_default_str();
  command
      ->add_option(
          "--planner", run.planner,
          "NAME, or UAV=NAME,... for some UAVs; NAME@AGENT: of that agent program; exec:CMD: a program of yours")
      ->capture_default_str();
  command->add_option("--agent", run.agent,
                      "Agent program with planners of your own (default: SKEIN_AGENT, else uav_agent)");
  const CLI::Validator seed(check_seed, ""), seconds(check_seconds, "");
  command->add_option("--seed", run.seed, "What chance draws; 0 draws nothing")->check(seed)->capture_default_str();
  command->add_option("--scene-seed", run.scene_seed, "Which scene of a procedural family")->check(seed);
  command->add_option("--assets", run.assets, "Folder with models/ for scenarios that read files");
  command->add_option("--duration", run.duration_s, "Mission time [s], instead of the scenario's")->check(seconds);
  command->add_option("--rules", run.rules, "Preset of rules, instead of the scenario's: contest, paper or reference");
  command->add_option("--faults", run.faults, "Fault file (YAML): what goes wrong, and when");
  CLI::Option* dds = command->add_option("--dds", run.dds, "DDS vendor: cyclonedds, fastdds or mixed")
                         ->check(CLI::IsMember({"cyclonedds", "fastdds", "mixed"}))
                         ->capture_default_str();
  command
      ->add_flag("--one-process", run.one_process,
                 "All programs in one process, without DDS: the same result on one core, and sooner")
      ->excludes(dds);
  command->add_option("--clock", run.clock, "lockstep, or realtime[:FACTOR]")
      ->check(CLI::Validator(check_clock, "CLOCK"))
      ->capture_default_str();
  CLI::Option* debug = command->add_option("--debug", run.debug_uav, "Leave this UAV's agent to you and your debugger");
  command
      ->add_option("--agent-timeout", run.agent_timeout_s,
                   "Wall time to wait for a program's answer before it counts as lost [s] (default 60)")
      ->check(seconds)
      ->excludes(debug);  // which waits until Ctrl-C, or until the debugged program ends
  command->add_flag("--native", run.native, "Let libm use this CPU's fastest code (the digest is then this CPU's own)");
  command->add_flag("--secure", run.secure, "Enforce the isolation of agents: certificates, encryption, user ids");
  command->add_option("--domain", run.domain, "First DDS domain; a free block is taken by default");
  add_network(*command, run.network);
  command->add_option("--stop-at", run.stop_at_s, "End the run at this simulated time [s]")->check(seconds);
  command->add_option("--out", run.out, "Results folder (default runs/<scenario>-<planner>-<seed>)");
  command->add_flag("--force", run.force, "Overwrite an existing result");
  command->add_flag("--no-oracle{false}", run.attainable, "Do not ask after the run what could have been had");
  command->footer(
      "Examples:\n"
      "  skein run towers --planner kios\n"
      "  skein run cranes --planner patrol,jurong=hover --seed 7 --out runs/mine\n"
      "  skein run towers --planner kios --faults config/faults/station_outage.yaml\n"
      "  skein run towers --agent build/my_agent --planner orbit\n"
      "  skein run towers --planner orbit@team_a/agent,jurong=kios@team_b/agent\n"
      "  skein run towers --planner hover,jurong=exec:./my_program");
  return command;
}

CLI::App* add_test(CLI::App& app, TestOptions& test) {
  CLI::App* command =
      app.add_subcommand("test", "Run the test suite, or your fault tests; the last line is 'N passed, N failed'");
  command->add_flag("--long", test.long_tests,
                    "Include the tests that take minutes; with --faults: repeat each in every way");
  CLI::Option* faults =
      command->add_option("--faults", test.faults, "A fault test (YAML) or a folder of them, instead of the suite");
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
  command->add_option("--seeds", test.seeds, "Fly each fault test with each of these seeds: 1-20 or 3,5,8")
      ->needs(faults);
  command->add_option("--jobs", test.jobs, "Flights at once; results do not depend on it")
      ->needs(faults)
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  command->add_option("--junit", test.junit, "File for a report as JUnit XML, as CI servers read it")->needs(faults);
  command->add_flag("-v,--verbose", test.verbose, "Tell what was seen where an expectation holds, too")->needs(faults);
  command->footer(
      "Examples:\n"
      "  skein test\n"
      "  skein test --faults config/faults/station_outage.yaml -v\n"
      "  skein test --faults my_tests --agent build/my_agent --seeds 1-20 --jobs 2 --junit faults.xml\n\n"
      "A fault test is described in docs/how-to-test-faults.md; config/faults/ has examples.\n"
      "Exit codes: 0 all passed, 1 one failed, 2 a file is wrong.");
  return command;
}

CLI::App* add_check(CLI::App& app, CheckOptions& check) {
  CLI::App* command =
      app.add_subcommand("check", "Validate scenarios, vehicles, fault files and fault tests, or reference vectors");
  command->add_option("FILE", check.files, "YAML files of any of these kinds");
  command->add_option("--golden", check.golden, "Run reference vectors (CSV) through the production code");
  command->add_option("--assets", check.assets, "Folder with models/ for scenarios that read files");
  command->add_option("--scenario", check.scenario, "What fault files are for that name no scenario themselves")
      ->capture_default_str();
  command->footer(
      "Examples:\n"
      "  skein check my_scenario.yaml my_vehicle.yaml my_faults.yaml\n"
      "  skein check my_faults.yaml --scenario cranes");
  return command;
}

CLI::App* add_scene(CLI::App& app, SceneOptions& scene) {
  CLI::App* command = app.add_subcommand("scene", "Write a scene as STL, PCD and boxes, with a scenario that flies it");
  command->add_option("SCENARIO", scene.scenario, "A name under config/scenarios/ or a YAML file")->required();
  command->add_option("--scene-seed", scene.scene_seed, "Which scene of a procedural family")
      ->check(CLI::Validator(check_seed, ""));
  command->add_option("--out", scene.out, "Folder to write to")->required();
  command->add_option("--assets", scene.assets, "Folder with models/ for scenarios that read files");
  command->add_flag("--force", scene.force, "Overwrite an earlier export");
  command->footer("Example:\n  skein scene towers --scene-seed 3 --out my_scene");
  return command;
}

CLI::App* add_bench(CLI::App& app, BenchOptions& bench) {
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
  command->add_option("--duration", bench.duration_s, "Mission time of the speed runs [s], instead of the scenario's")
      ->check(CLI::Validator(check_seconds, ""));
  command->add_option("--json", bench.json, "File for all figures");
  command->footer("Example:\n  skein bench --quick --json bench.json");
  return command;
}

/// Unlike CLI::Range this refuses "nan" too.
std::string check_clearance(const std::string& text) {
  char* end = nullptr;
  const double clearance = std::strtod(text.c_str(), &end);
  const bool fits = end != text.c_str() && *end == '\0' && clearance >= 0.0 && clearance <= 100.0;
  return fits ? "" : "must be a number within [0, 100], not '" + text + "'";
}

CLI::App* add_oracle(CLI::App& app, OracleOptions& oracle) {
  CLI::App* command = app.add_subcommand("oracle", "What could be had of a scenario with full knowledge of its scene");
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
      ->check(CLI::Validator(check_clearance, ""));
  command->add_flag("--vehicle", oracle.vehicle,
                    "A sphere about body and rotors keeps the clearance (default then 0), not the camera");
  command->add_flag("--outside", oracle.outside_only, "Only what can be had from outside, not through windows");
  command->add_flag("--json", oracle.json, "All figures, for programs");
  command->footer("Example:\n  skein oracle towers --clearance 0.5,0.8,1.2");
  return command;
}

/// What `skein contest` and `skein compare` have in common.
void add_study_options(CLI::App& command, StudyOptions& study) {
  const CLI::Validator seconds(check_seconds, "");
  command.add_option("--planners", study.planner_lists, "A,B,... with parameters if any: kios,xxh:faithful=true,star")
      ->allow_extra_args(false);
  command.add_option("--planner", study.planners, "One more, as for `skein run`: fleets of several, any command")
      ->allow_extra_args(false);
  command
      .add_option("--scenarios", study.scenarios, "Names under config/scenarios/ or YAML files, with commas between")
      ->delimiter(',')
      ->allow_extra_args(false);
  command.add_option("--assets", study.assets, "Folder with models/ for scenarios that read files");
  command.add_option("--duration", study.duration_s, "Mission time [s], instead of the scenarios'")->check(seconds);
  command.add_option("--rules", study.rules, "Preset of rules, instead of the scenarios': contest, paper or reference");
  command
      .add_option("--dds", study.dds,
                  "Fly as processes over this DDS vendor: cyclonedds, fastdds or mixed (default: each fleet in one "
                  "process where it can; the results are the same)")
      ->check(CLI::IsMember({"cyclonedds", "fastdds", "mixed"}));
  add_network(command, study.network);
  command.add_option("--agent", study.agent, "Agent program with planners of your own, as for `skein run`");
  command.add_option("--out", study.out, "Folder of flights and report (default runs/" + command.get_name() + ")");
  command
      .add_option("--jobs", study.jobs,
                  "Flights at once; results do not depend on it (default: as many as cores, over DDS one)")
      ->check(CLI::Range(1, 64));
  command.add_flag("--force", study.force, "Go on in a folder of other settings; flights that fit are kept");
  const bool contest = command.get_name() == "contest";
  command.footer(std::string("Example:\n  skein ") +
                 (contest ? "contest --planners kios,xxh,star --tests 3\n\n"
                          : "compare --planners kios,patrol --scenarios towers,cranes --seeds 1-5\n\n") +
                 "The same command again goes on where it was stopped. docs/how-to-compare-planners.md has more.");
}

CLI::App* add_contest(CLI::App& app, StudyOptions& contest, int& tests) {
  CLI::App* command =
      app.add_subcommand("contest", "The contest's protocol: tests of all scenes, totals and a ranking");
  add_study_options(*command, contest);
  command->add_option("--tests", tests, "Number of tests; test N is seed N of every scene")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  const auto set_rank = [&contest](const std::string& by) {
    contest.rank = by == "max" ? Rank::maximum : by == "median" ? Rank::median : Rank::worst;
  };
  command
      ->add_option_function<std::string>("--rank", set_rank,
                                         "By the greatest total of a test (max), the median or the worst")
      ->check(CLI::IsMember({"max", "median", "worst"}))
      ->default_str("max");
  return command;
}

CLI::App* add_compare(CLI::App& app, StudyOptions& study) {
  CLI::App* command = app.add_subcommand("compare", "Planners side by side over any scenes and seeds");
  add_study_options(*command, study);
  command->add_option("--seeds", study.seeds, "How many (seeds 0 to K-1), or which: 3,5,8 or 1-5")
      ->capture_default_str();
  command->add_option("--scene-seed", study.scene_seed, "Which scene of a procedural family")
      ->check(CLI::Validator(check_seed, ""));
  return command;
}

/// What only `skein doctor net` has a use for.
void check_doctor(const DoctorOptions& doctor) {
  if (doctor.net) return;
  const auto refuse = [](bool given, const std::string& option) {
    if (given) throw InputError(option + ": only `skein doctor net` has a use for it");
  };
  refuse(doctor.name.has_value(), "--as");
  refuse(!doctor.only.empty(), "--only");
  refuse(doctor.seconds.has_value(), "--seconds");
}

CLI::App* add_doctor(CLI::App& app, DoctorOptions& doctor) {
  CLI::App* command = app.add_subcommand("doctor", "What of this machine or network is in a fleet's way, and its mend");
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
  return command;
}

/// What cannot be had without processes.
void check_one_process(const RunOptions& run) {
  if (!run.one_process) return;
  const auto refuse = [](bool given, const std::string& option, const std::string& why) {
    if (given) throw InputError(option + " needs processes: " + why + "; leave out --one-process");
  };
  refuse(run.debug_uav.has_value(), "--debug", "the program that you debug is one of its own");
  refuse(run.secure, "--secure", "it keeps programs apart that cannot see each other's memory");
  refuse(run.domain.has_value(), "--domain", "a fleet in one process uses no DDS domain");
}

}  // namespace

Command parse_command_line(const std::vector<std::string>& arguments) {
  CLI::App app("Skein: a fleet of inspection UAVs, simulated as separate processes that talk over DDS.", "skein");
  app.require_subcommand(1);
  app.set_version_flag("--version", "skein " SKEIN_VERSION);
  app.failure_message(CLI::FailureMessage::simple);
  app.footer("Example:\n  skein run towers --planner kios\n\n`skein COMMAND --help` has the options of a command.");
  RunOptions run;
  TestOptions test;
  CheckOptions check;
  SceneOptions scene;
  BenchOptions bench;
  OracleOptions oracle;
  DiffOptions diff;
  DoctorOptions doctor;
  StudyOptions contest, compare;
  contest.contest = true;
  int tests = 5;

  const CLI::App* run_command = add_run(app, run);
  const CLI::App* test_command = add_test(app, test);
  add_check(app, check);
  const CLI::App* scene_command = add_scene(app, scene);
  const CLI::App* bench_command = add_bench(app, bench);
  const CLI::App* oracle_command = add_oracle(app, oracle);
  const CLI::App* contest_command = add_contest(app, contest, tests);
  const CLI::App* compare_command = add_compare(app, compare);
  const CLI::App* doctor_command = add_doctor(app, doctor);
  CLI::App* diff_command = app.add_subcommand("diff", "First step, entity and field in which two runs differ");
  diff_command->add_option("RUN_A", diff.run_a, "A results folder")->required();
  diff_command->add_option("RUN_B", diff.run_b, "Another one")->required();
  diff_command->footer("Example:\n  skein diff runs/towers-kios-0 runs/again");

  std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());  // as CLI11 wants them
  try {
    app.parse(std::move(reversed));
  } catch (const CLI::CallForHelp&) {
    // Of the command that was named, if any.
    return HelpText{app.help(), run_command->parsed() || contest_command->parsed() || compare_command->parsed()};
  } catch (const CLI::CallForVersion& version) {
    return HelpText{std::string(version.what()) + "\n"};
  } catch (const CLI::ParseError& error) {
    throw InputError(std::string(error.what()) + "\nSee `skein --help` or `skein COMMAND --help`.");
  }
  refuse_empty_values(app);
  if (run_command->parsed()) {
    check_one_process(run);
    return run;
  }
  if (test_command->parsed()) return test;
  if (scene_command->parsed()) return scene;
  if (bench_command->parsed()) return bench;
  if (oracle_command->parsed()) return oracle;
  if (diff_command->parsed()) return diff;
  if (doctor_command->parsed()) return doctor;
  contest.seeds = "1-" + std::to_string(tests);
  if (contest_command->parsed()) return contest;
  if (compare_command->parsed()) return compare;
  if (check.files.empty() && check.golden.empty()) throw InputError("check: give files, or --golden FILE.csv");
  return check;
}

}  // namespace skein::cli
