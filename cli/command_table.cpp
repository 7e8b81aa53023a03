#include "cli/command_table.hpp"

#include <memory>

#include "cli/attach_command.hpp"
#include "cli/bench_command.hpp"
#include "cli/blame_command.hpp"
#include "cli/check_command.hpp"
#include "cli/check_planner_command.hpp"
#include "cli/compose_command.hpp"
#include "cli/convert_command.hpp"
#include "cli/diff_command.hpp"
#include "cli/doctor_command.hpp"
#include "cli/fleet_command.hpp"
#include "cli/hunt/capsule_run.hpp"
#include "cli/hunt_command.hpp"
#include "cli/keys_command.hpp"
#include "cli/merge_command.hpp"
#include "cli/oracle_command.hpp"
#include "cli/pack_command.hpp"
#include "cli/replay_command.hpp"
#include "cli/report_command.hpp"
#include "cli/rerun_command.hpp"
#include "cli/run_command.hpp"
#include "cli/scene_command.hpp"
#include "cli/study_command.hpp"
#include "cli/test_command.hpp"

namespace skein::cli {
namespace {

using Arguments = std::vector<std::string>;

/// One command.
/// @param add     adds it to the command line, with the options that CLI11 parses into the struct
/// @param action  executes it
/// @param finish  optional: checks and completes the options once they are parsed; gets the whole command line
template <class Options, class Action>
std::function<TakeCommand(CLI::App&)> entry(void (*add)(CLI::App&, Options&), Action action,
                                            void (*finish)(Options&, const Arguments&) = nullptr) {
  return [=](CLI::App& app) -> TakeCommand {
    const auto options = std::make_shared<Options>();
    add(app, *options);
    return [=](const Arguments& arguments) {
      if (finish != nullptr) finish(*options, arguments);
      return Command(*options, action);
    };
  };
}

int run_mission(const RunOptions& options, const Console& console) {
  return is_capsule(options) ? run_capsule(options, console) : run_fleet(options, console);
}

}  // namespace

const std::vector<CommandEntry>& command_table() {
  static const std::string kFly = "Fly a fleet", kExamine = "Examine runs", kCompare = "Compare planners",
                           kFaults = "Find faults", kOther = "Scenarios and machines";
  static const std::vector<CommandEntry> kCommands = {
      {kFly, entry(add_run, run_mission, finish_run)},
      {kFly, entry(add_compose, compose_fleet, finish_compose)},
      {kFly, entry(add_keys, make_keys)},
      {kFly, entry(add_fleet, step_fleet)},
      {kFly, entry(add_ps, list_fleets)},
      {kExamine, entry(add_report, make_reports)},
      {kExamine, entry(add_replay, replay_run)},
      {kExamine, entry(add_diff, diff_runs)},
      {kExamine, entry(add_merge, merge_reports)},
      {kCompare, entry(add_compare, run_study, finish_study)},
      {kCompare, entry(add_contest, run_study, finish_study)},
      {kCompare, entry(add_oracle, consult_oracle)},
      {kCompare, entry(add_check_planner, check_planner)},
      {kFaults, entry(add_attach, attach_to)},
      {kFaults, entry(add_rerun, rerun)},
      {kFaults, entry(add_fork, fork_run)},
      {kFaults, entry(add_test, run_tests)},
      {kFaults, entry(add_convert, convert_files)},
      {kFaults, entry(add_hunt, run_hunt, finish_hunt)},
      {kFaults, entry(add_blame, blame)},
      {kOther, entry(add_check, check_files, finish_check)},
      {kOther, entry(add_scene, [](const SceneOptions& options, const Console&) { return export_scene(options); })},
      {kOther, entry(add_bench, run_bench)},
      {kOther, entry(add_doctor, [](const DoctorOptions& options, const Console&) { return consult_doctor(options); })},
      {kOther, entry(add_pack, pack_programs)},
  };
  return kCommands;
}

}  // namespace skein::cli
