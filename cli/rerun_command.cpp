#include "cli/rerun_command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

#include "cli/command_line.hpp"
#include "cli/compose_options.hpp"
#include "cli/hunt/capsule_run.hpp"
#include "cli/option_checks.hpp"
#include "cli/run_command.hpp"
#include "core/faults/fault_plan.hpp"
#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "process/json_text.hpp"
#include "process/program.hpp"
#include "results/result_file.hpp"
#include "results/run_folder.hpp"
#include "run/drawn_world.hpp"
#include "run/fleet_plan.hpp"
#include "run/hand_flights.hpp"
#include "run/python_planners.hpp"
#include "run/recording.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

/// The options with which a command flies: for a capsule, those in its file, and a few of the command's own.
RunOptions options_flown(const RunOptions& given) {
  if (!is_capsule(given)) return given;
  RunOptions options = load_fault_test(given.scenario, given.assets, given.agent, given.one_process).plan.options;
  options.dds = given.dds;
  options.one_process = given.one_process;  // choose_processes() decides for a fleet that is too large for DDS
  options.attainable = given.attainable;
  options.report = given.report;
  options.command = given.command;
  return options;
}

/// What helps if the command's files have changed since the run: its relative names start from the current folder.
std::string where_to_start(const Json& result) {
  return ". Start from the folder in which that run was started, with the files that it had: " +
         text_in(result, "command");
}

/// @param scenario  that the command names now. @throws InputError if it is another one, or has another fleet or seed
void check_flies_the_run(const RunOptions& options, const Scenario& scenario, const fs::path& run, const Json& result) {
  std::vector<std::string> differences;
  const auto compare = [&](const std::string& what, const std::string& then, const std::string& now) {
    if (!then.empty() && then != now) differences.push_back(what + " " + then + ", now " + now);
  };
  // `skein merge` notes the scenario's file, also where the command has a name.
  const std::string then = fs::path(text_in(result, "scenario")).stem(), file = scenario.file.stem();
  if (then != file) compare("scenario", then, fs::path(options.scenario).stem());
  compare("UAVs", joined(fleet_of(result)), joined(scenario.uav_names()));
  compare("seed", result.contains("seed") ? result["seed"].dump() : "", std::to_string(options.seed));
  if (differences.empty()) return;
  throw InputError(run.string() + ": the command of this run now flies a different run: " + joined(differences, "; ") +
                   where_to_start(result));
}

/// The options of the flight of a run's command, as the command's files say now.
/// @throws InputError if a file is not there, or not valid, or the command flies another run now
RunOptions options_now(const RunOptions& given, const fs::path& run, const Json& result) {
  const auto reading = [&](const auto& read) {
    try {
      return read();
    } catch (const InputError& error) {
      throw InputError(run.string() + ": its command cannot be repeated: " + error.what() + where_to_start(result));
    }
  };
  RunOptions options = reading([&] { return options_flown(given); });
  const Scenario scenario = reading([&] { return scenario_flown(options, false); });
  check_flies_the_run(options, scenario, run, result);
  // The faults, with those that the user added in flight. `run` is where the folder is now: it may have been moved.
  if (fs::exists(run / run_folder::kByHand)) options.faults = run / run_folder::kByHand;
  reading([&] { return load_fault_plan(options.faults.value_or(""), scenario, options.seed); });
  return options;
}

/// The options as the user gave them then, without those that only that run needed: output, debugging, view, security,
/// and the hosts of its programs.
RunOptions options_of(const fs::path& run, const Json& result) {
  const std::string command = text_in(result, "command");
  std::vector<std::string> words = shell_words(command);
  if (words.empty()) {
    throw InputError(run.string() + ": its result does not say how it was started, so it cannot be flown again");
  }
  words.erase(words.begin());
  const Command parsed = parse_command_line(words);
  const auto* flown = parsed.get_if<RunOptions>();
  const auto* in_containers = parsed.get_if<ComposeOptions>();
  if (flown == nullptr && in_containers == nullptr) throw InputError(run.string() + ": it was not a run: " + command);
  RunOptions options = options_now(flown != nullptr ? *flown : in_containers->run, run, result);
  options.out.reset();
  options.debug.clear();
  options.log.clear();
  options.break_at_s.reset();
  options.break_on.reset();
  options.break_from.reset();
  options.domain.reset();
  options.network.reset();
  options.place = {};
  options.view = {};
  options.secure = options.force = options.one_process = options.cores = false;
  options.record = "run";
  options.keep_maps_s.reset();
  // The person who flew by hand is gone, but the run kept the commands.
  options.planner = planners_repeated(options.planner, fleet_of(result), [&](const std::string& uav) {
    return fs::absolute(run / run_folder::hand_file(uav));
  });
  options.planner = with_python_files_of(options.planner, fleet_of(result), run, result,
                                         [](const std::string& text) { std::cerr << text << std::endl; });
  return options;
}

/// @param result  of the run, which must be the one that was recorded. @throws InputError
ReplayOf replay_of(const fs::path& run, const Json& result) {
  const fs::path recording = fs::absolute(run / run_folder::kRecording);
  if (!fs::exists(recording)) {
    throw InputError(run.string() + ": there is no " + run_folder::kRecording + " in it (`skein run` leaves one)");
  }
  const std::string recorded = recorded_digest(mcap::Reader::whole(recording)), digest = text_in(result, "digest");
  if (!recorded.empty() && !digest.empty() && recorded != digest) {
    throw InputError(recording.string() + ": is the recording of another run: its digest is " + recorded +
                     ", and that in " + run_folder::kResult + " is " + digest);
  }
  return {recording, std::nullopt, {}, {}};
}

/// Chooses one process where that is possible: it is faster, and the result is the same.
void choose_processes(const Reflight& reflight, RunOptions& options) {
  options.dds = reflight.dds.value_or(options.dds);
  options.debug = reflight.debug;
  options.agent = reflight.agent ? reflight.agent : options.agent;
  options.force = reflight.force;
  if (!reflight.debug.empty()) {  // the user may look at a program for any time
    options.agent_timeout_s.reset();
    options.lease_s.reset();
  }
  if (reflight.dds || !reflight.debug.empty()) return;
  options.one_process = plan_fleet(options, program_dir(), Processes::one_if_possible).options.one_process;
}

/// Members whose planner has changed. @param then, now  options of the two runs.
std::vector<std::string> with_other_planner(const RunOptions& then, const RunOptions& now) {
  const FleetPlan before = plan_fleet(then, program_dir(), Processes::one_if_possible);
  const FleetPlan after = plan_fleet(now, program_dir(), Processes::one_if_possible);
  std::vector<std::string> members;
  for (const UavPlanner& planner : after.planners) {
    const bool is_same = std::ranges::any_of(before.planners, [&](const UavPlanner& other) {
      return other.uav == planner.uav && written(other) == written(planner);
    });
    if (!is_same) members.push_back(planner.uav);
  }
  const auto ground = [](const FleetPlan& plan) { return plan.ground ? written(*plan.ground) : std::string(); };
  if (after.ground && ground(before) != ground(after)) members.push_back("gcs");
  return members;
}

/// Says, for the user, how the digest has changed; empty if it is the same, or a run has none.
std::string other_digest(const Json& then, const Json& now) {
  const std::string before = text_in(then, "digest"), after = text_in(now, "digest");
  if (before.empty() || after.empty() || before == after) return {};
  return "the simulated world differs from that of the recorded run: its digest was " + before + ", and is now " +
         after + "; has the version, the build or a scenario file changed?";
}

/// UAVs that an agent flies, not a program of the user's own.
std::vector<std::string> uavs_with_agents(const RunOptions& options) {
  std::vector<std::string> uavs;
  for (const UavPlanner& planner : plan_fleet(options, program_dir(), Processes::one_if_possible).planners) {
    if (!exec_command(planner.spec)) uavs.push_back(planner.uav);
  }
  return uavs;
}

/// A fork changes what comes after a time, so the recorded run must go on after it. @throws InputError
void require_within(double at_s, const Json& then) {
  const double end_s = number_in(then, "sim_time_s");
  if (at_s < end_s) return;
  throw InputError("--at " + shortest(at_s) + ": the run ended at " + number_text(end_s) +
                   " s, so nothing would change; give an earlier time");
}

void add_reflight(CLI::App& command, Reflight& reflight) {
  command.add_option("RUN", reflight.run, "Results folder of the recorded run")->required();
  command.add_option("--agent", reflight.agent, "Agent program with planners of your own");
  command
      .add_option("--dds", reflight.dds,
                  "Fly as processes over this DDS vendor: cyclonedds, fastdds or mixed (default: in one process where "
                  "possible; the result is the same)")
      ->check(CLI::IsMember({"cyclonedds", "fastdds", "mixed"}));
  command.add_option("--out", reflight.out, "Results folder (default: a new one in RUN)");
  command.add_flag("--force", reflight.force, "Overwrite an existing result");
}

}  // namespace

void add_rerun(CLI::App& app, RerunOptions& rerun) {
  CLI::App* command = app.add_subcommand(
      "rerun", "Run one UAV's software again with the inputs of a recorded run, and compare its output");
  add_reflight(*command, rerun.reflight);
  command->add_option("--uav", rerun.uav, "UAV whose software runs (gcs: the program at the ground station)")
      ->required();
  command->add_option("--planner", rerun.planner, "Run this planner instead of the recorded one, with the same inputs");
  command
      ->add_option("--debug", rerun.reflight.debug,
                   "UAV[=TOOL]: run the UAV's program in gdb or with another tool, as for `skein run`")
      ->allow_extra_args(false)
      ->excludes("--dds");
  command->footer(
      "Examples:\n"
      "  skein rerun runs/towers-kios-0 --uav jurong\n"
      "  skein rerun runs/towers-kios-0 --uav jurong --agent build/my_agent\n\n"
      "Exit codes: 0 the output is the recorded one, 1 it differs. See docs/how-to-rerun.md.");
}

void add_fork(CLI::App& app, ForkOptions& fork) {
  CLI::App* command =
      app.add_subcommand("fork", "Fly a recorded run again, and continue it differently from a given time on");
  add_reflight(*command, fork.reflight);
  command
      ->add_option(
          "--at", fork.at_s,
          "Simulated time [s]: before it, the recorded output of all programs counts, from then on their new output")
      ->required()
      ->check(CLI::Validator(check_seconds, ""));
  command->add_option("--planner", fork.planner,
                      "UAV=NAME,...: these planners take over at that time; they receive their inputs from the start");
  command->footer(
      "Example:\n  skein fork runs/towers-kios-0 --at 120 --planner jurong=patrol\n\nSee docs/how-to-rerun.md.");
}

std::vector<std::string> fleet_of(const Json& result) {
  std::vector<std::string> names;
  for (const Json& uav : value_or(result, "uavs", Json::array())) {
    names.push_back(text_in(uav, "name"));
  }
  return names;
}

RunOptions options_of_run(const fs::path& run) { return options_of(run, results::read_result_file(run)); }

int rerun(const RerunOptions& options, const Console& console) {
  const Json then = results::read_result_file(options.reflight.run);
  RunOptions run = options_of(options.reflight.run, then);
  run.replay = replay_of(options.reflight.run, then);
  run.replay->only = {options.uav};
  for (const std::string& debug : options.reflight.debug) {
    if (debug.substr(0, debug.find('=')) != options.uav) {
      throw InputError("--debug " + debug + ": only the program of " + options.uav + " runs (--uav)");
    }
  }
  if (options.planner) run.planner += "," + options.uav + "=" + *options.planner;
  run.attainable = run.report = false;
  choose_processes(options.reflight, run);
  run.out = options.reflight.out;
  run.usual_out = options.reflight.run / ("rerun-" + options.uav);
  const RunEnd end = fly_fleet(run, console);
  if (end.code != kExitDone) return end.code;
  const Json now = results::read_result_file(end.dir);
  if (const std::string other = other_digest(then, now); !other.empty()) console.out << other << '\n';
  const std::vector<std::string> differences = texts_in(now, "differences");
  for (const std::string& difference : differences) console.out << difference << '\n';
  if (differences.empty()) console.out << options.uav << ": the output is the recorded one\n";
  console.out << std::flush;
  return differences.empty() && text_in(then, "digest") == text_in(now, "digest") ? kExitDone : kExitCheckFailed;
}

ThoughtAgain think_again_with_maps(const fs::path& run, const fs::path& out, const Console& console) {
  constexpr double kUsualPeriod_s = 10.0;
  const Json then = results::read_result_file(run);
  RunOptions options = options_of(run, then);
  options.replay = replay_of(run, then);
  options.replay->only = uavs_with_agents(options);
  if (options.replay->only.empty()) {
    throw InputError(run.string() + ": programs of your own flew all its UAVs, and they keep no maps");
  }
  options.attainable = options.report = false;
  options.record = "none";
  options.keep_maps_s = kUsualPeriod_s;
  Reflight reflight;
  reflight.force = true;
  choose_processes(reflight, options);
  options.out = out;
  const int code = run_fleet(options, console);
  if (code != kExitDone) return {code, {}};
  const Json now = results::read_result_file(out);
  std::vector<std::string> different = texts_in(now, "differences");
  if (std::string other = other_digest(then, now); !other.empty()) different.push_back(std::move(other));
  return {code, std::move(different)};
}

int fork_run(const ForkOptions& options, const Console& console) {
  const Json then = results::read_result_file(options.reflight.run);
  require_within(options.at_s, then);
  RunOptions run = options_of(options.reflight.run, then);
  const RunOptions as_it_was = run;
  ReplayOf replay = replay_of(options.reflight.run, then);
  replay.until_s = options.at_s;
  if (options.planner && options.planner->find('=') == std::string::npos) {
    throw InputError("--planner " + *options.planner + ": must be UAV=PLANNER, since the others fly as recorded");
  }
  if (options.planner) run.planner += "," + *options.planner;
  run.agent = options.reflight.agent ? options.reflight.agent : run.agent;
  if (options.planner) replay.other = with_other_planner(as_it_was, run);
  run.replay = std::move(replay);
  choose_processes(options.reflight, run);
  run.out = options.reflight.out;
  run.usual_out = options.reflight.run / "fork";
  const RunEnd end = fly_fleet(run, console);
  const Json now = read_json(end.dir / run_folder::kResult);
  if (!now.is_object()) return end.code;
  for (const std::string& difference : texts_in(now, "differences")) console.out << difference << '\n';
  const auto score = [](const Json& result) { return number_in(result, "score"); };
  console.out << "score " << score(now) << "; the recorded run scored " << score(then) << "\n";
  if (const std::string digest = text_in(then, "digest"); !digest.empty() && digest == text_in(now, "digest")) {
    console.out << "the fork is the same run: its digest did not change\n";
  }
  console.out << std::flush;
  return end.code;
}

}  // namespace skein::cli
