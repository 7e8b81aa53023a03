#include "cli/run_command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>
#include <sstream>

#include "cli/flight_options.hpp"
#include "cli/option_checks.hpp"
#include "cli/place/place_commands.hpp"
#include "cli/place/placed_fleet.hpp"
#include "cli/place_options.hpp"
#include "cli/ros_environment.hpp"
#include "cli/run_results.hpp"
#include "cli/secure/security.hpp"
#include "cli/view_options.hpp"
#include "core/text/text.hpp"
#include "debug/core_file.hpp"
#include "host/domain_block.hpp"
#include "host/environment.hpp"
#include "host/preflight.hpp"
#include "host/threads.hpp"
#include "process/host/memory.hpp"
#include "results/run_folder.hpp"
#include "run/break_event.hpp"
#include "run/fleet_plan.hpp"
#include "run/fleet_programs.hpp"
#include "run/fleet_run.hpp"
#include "run/inputs_outlast.hpp"
#include "run/live_page.hpp"
#include "run/memory_need.hpp"
#include "run/open_files.hpp"
#include "run/results_dir.hpp"

namespace skein::cli {
namespace {

void check_before_flight(const FleetPlan& plan, const Console& console) {
  const auto users = plan.options.secure ? check_agents_access(plan) : nullptr;
  const ScratchDir scratch;
  run_checks(check_programs(plan, scratch.path(), users ? std::optional(users->at(0)) : std::nullopt),
             [&](const std::string& waiting) { console.err << waiting << std::endl; });
}

/// @returns a warning of a limit that may be too low; empty: none. @throws InputError
std::string check_results_dir_and_limits(const RunOptions& options, const FleetPlan& plan) {
  const std::filesystem::path dir = results_dir_of(options, plan.scenario.name);
  check_inputs_outlast(plan, dir);
  ResultsDir::check(dir, options.force);
  check_memory(plan, memory_left());
  return allow_open_files(plan);
}

/// @param domains  null: all programs in one process, without DDS.
std::string start_line(const FleetPlan& plan, const DomainBlock* domains, const std::filesystem::path& out) {
  const std::string place =
      domains != nullptr ? "DDS domains " + std::to_string(domains->base()) + ".." + std::to_string(domains->last())
                         : "in one process";
  return plan.scenario.name + ": " + std::to_string(plan.scenario.fleet.size()) + " UAVs, planner " +
         plan.options.planner + ", seed " + std::to_string(plan.options.seed) + ", " + place + ", results in " +
         out.string();
}

/// Warns the user of settings of the environment that may affect the run, and of the limit of open files.
void warn_of_surroundings(const DomainBlock* domains, const std::string& open_files, FleetRun& run) {
  std::vector<std::string> warnings = environment_warnings();
  if (!open_files.empty()) warnings.push_back(open_files);
  for (const std::string& warning : warnings) {
    run.view().message("warning: " + warning);
    run.facts().warnings.push_back(warning);
  }
  if (domains != nullptr && domains->last() > kLastQuietDomain) {
    run.facts().warnings.push_back("DDS domains above " + std::to_string(kLastQuietDomain) +
                                   " use ports that the system may give to other programs");
  }
}

/// Warns of files that agents of a secured fleet can read although they should not.
void warn_of_exposure(const FleetPlan& plan, const PlacedFleet* placed, FleetRun& run) {
  std::vector<std::string> exposed = exposed_files(plan);
  if (placed != nullptr) std::ranges::copy(placed->security_warnings(), std::back_inserter(exposed));
  for (const std::string& warning : exposed) {
    run.view().message(warning);
    run.facts().warnings.push_back(warning);
  }
}

/// Connects to the hosts of --place and makes sure that the fleet can fly there. @returns null without --place.
std::unique_ptr<PlacedFleet> place_fleet(FleetPlan& plan, const Console& console) {
  if (!plan.options.place.at) return nullptr;
  auto placed = std::make_unique<PlacedFleet>(plan, read_placement(plan));
  placed->take_domains(plan.options.domain, domain_count(plan));
  plan.options.network = placed->network();
  if (plan.options.check) placed->ask_doctors([&](const std::string& text) { console.err << text << std::endl; });
  return placed;
}

/// With a terminal, --debug UAV means --debug UAV=gdb.
RunOptions with_debugger(RunOptions options, const Console& console) {
  for (std::string& value : options.debug) {
    if (console.keyboard && !options.secure && value.find('=') == std::string::npos) value += "=gdb";
  }
  return options;
}

/// Flies the flight that is to be debugged without the debugger. Keeps and shows nothing. @returns its result.json.
Json fly_quietly(const FleetPlan& plan) {
  RunOptions options = plan.options;
  options.debug.clear();
  options.log.clear();
  options.domain.reset();
  // A program that crashes would end the whole process.
  options.one_process = options.break_on != "lost" && !needs_processes(plan);
  options.break_on.reset();
  options.view = {};
  options.cores = false;
  options.attainable = options.report = false;
  options.record = "none";
  const ScratchDir scratch;
  options.out = scratch.path() / "run";
  std::ostringstream unseen;
  if (run_fleet(options, {unseen, unseen}) == kExitInterrupted) throw Interrupted{};
  return read_json(*options.out / run_folder::kResult);
}

/// Turns --break-on into --break-at: finds the time of the event.
void find_break(RunOptions& options, const Console& console) {
  if (!options.break_on) return;
  const FleetPlan plan = plan_fleet(options, program_dir());
  if (!options.break_from)
    console.err << "flying once to find the time of --break-on " << *options.break_on << std::endl;
  const Json result = options.break_from ? result_of_same_flight(*options.break_from, plan) : fly_quietly(plan);
  const std::string& member = plan.debug.front().member;
  options.break_at_s = event_time_s(result, member, *options.break_on);
  if (!options.break_at_s) throw InputError("--break-on " + *options.break_on + ": it never happened to " + member);
  console.err << member << ": " << *options.break_on << " at " << shortest(*options.break_at_s) << " s" << std::endl;
}

/// Refuses the options that need separate processes. @throws InputError
void check_one_process(const RunOptions& run) {
  if (!run.one_process) return;
  const auto refuse = [](bool given, const std::string& option, const std::string& why) {
    if (given) throw InputError(option + " needs processes: " + why + "; leave out --one-process");
  };
  refuse(!run.debug.empty(), "--debug", "the debugger needs a process with only this program");
  refuse(run.cores, "--cores", "there would be one core file for all programs");
  refuse(run.domain.has_value(), "--domain", "a fleet in one process uses no DDS domain");
  refuse(run.place.at.has_value(), "--place", "they run on several hosts");
}

}  // namespace

void add_run(CLI::App& app, RunOptions& run) {
  CLI::App* command = app.add_subcommand("run", "Fly a fleet through a scenario and write its results");
  add_flight_options(*command, run);
  add_programs(*command, run, " and, with --place, whether the hosts receive each other's messages");
  command
      ->add_flag("--one-process", run.one_process,
                 "Run all programs in one process, without DDS: the same result in less time")
      ->excludes("--dds");
  command
      ->add_option("--threads", run.threads,
                   "Number of threads with --one-process; results do not depend on it (default: SKEIN_THREADS, else "
                   "the available cores, at most one per UAV)")
      ->needs("--one-process")
      ->check(CLI::Range(1, kMostThreads));
  command
      ->add_option("--debug", run.debug,
                   "Debug this program while the fleet waits: a UAV, gcs, sim_server, comm_router or station. TOOL: "
                   "gdb, or pdb for a planner in Python, in this terminal; gdbserver:PORT; wait (until you attach a "
                   "debugger); or a command that Skein puts before the program's command line (default: gdb; without a "
                   "terminal, Skein prints a command for you to start)")
      ->type_name("UAV[=TOOL]")
      ->allow_extra_args(false)
      ->excludes("--agent-timeout");  // with --debug the fleet waits until Ctrl-C, or until the debugged program ends
  command
      ->add_option("--break-at", run.break_at_s,
                   "Stop the debugged programs in the exchange before this simulated time [s]")
      ->check(CLI::Validator(check_seconds, ""))
      ->needs("--debug");
  command
      ->add_option("--break-on", run.break_on,
                   "Like --break-at, before this event first happens to the first UAV of --debug; to find the time, "
                   "Skein flies the fleet once beforehand")
      ->check(CLI::IsMember(std::vector<std::string>(kBreakEvents.begin(), kBreakEvents.end())))
      ->needs("--debug")
      ->excludes("--break-at");
  command
      ->add_option("--break-from", run.break_from,
                   "Results folder of the same flight, in which Skein looks up the time instead of flying beforehand")
      ->needs("--break-on");
  command->add_flag("--cores", run.cores, "Keep the core file of a crashed program in the results folder");
  command->add_option("--domain", run.domain, "First DDS domain of the fleet (default: the first free block)");
  command
      ->add_option(
          "--ros-env", run.ros_env,
          "Do not fly: print settings for a shell with this UAV's ROS 2 nodes, for eval. They are for the fleet that "
          "flies now (select one of several by --out), or with --domain for a fleet that you start later")
      ->type_name("UAV");
  add_network(*command, run.network);
  add_place_options(*command, run.place);
  add_result_options(*command, run);
  add_view_options(*command, run.view);
  command->footer(
      "Examples:\n"
      "  skein run towers --planner kios\n"
      "  skein run cranes --planner patrol,jurong=hover --seed 7 --out runs/mine\n"
      "  skein run towers --planner kios --faults config/faults/station_outage.yaml\n"
      "  skein run towers --agent build/my_agent --planner orbit\n"
      "  skein run towers --planner orbit@team_a/agent,jurong=kios@team_b/agent\n"
      "  skein run towers --planner hover,jurong=exec:./my_program\n"
      "  skein run towers --planner kios --debug jurong=gdb\n"
      "  skein run towers --planner kios --view\n"
      "  skein run towers --planner kios --place jurong=host1,raffles=host2");
}

void finish_run(RunOptions& run, const std::vector<std::string>& arguments) {
  check_one_process(run);
  check_view(run);
  run.command = "skein " + shell_line(arguments);
}

int run_fleet(const RunOptions& options, const Console& console) { return fly_fleet(options, console).code; }

RunEnd fly_fleet(const RunOptions& given, const Console& console) {
  if (given.ros_env) {
    console.out << ros_environment(given) << std::flush;
    return {kExitDone};
  }
  RunOptions options = with_debugger(given, console);
  find_break(options, console);
  FleetPlan plan = plan_fleet(options, program_dir());
  if (options.place.print) {
    console.out << place_commands(plan, read_placement(plan)) << std::flush;
    return {kExitDone};
  }
  const std::string open_files = check_results_dir_and_limits(options, plan);
  std::optional<LivePage> page;
  if (options.view.at) plan.watched = page.emplace(view::read_endpoint(*options.view.at)).watched();
  if (options.check) check_before_flight(plan, console);
  std::optional<DomainBlock> own_domains;
  const DomainBlock* domains = nullptr;
  auto placed = place_fleet(plan, console);
  if (placed) {
    domains = &placed->domains();
  } else if (!options.one_process) {
    domains = &own_domains.emplace(options.domain, domain_count(plan));
  }
  const int base_domain = domains != nullptr ? domains->base() : kFirstDomain;
  const auto out = ResultsDir::take(options, plan.scenario.name);
  const std::filesystem::path& dir = out->given();

  if (options.cores) allow_cores();
  FleetRun run(plan, console.err, console.terminal);
  if (domains != nullptr) run.tend(*domains);
  run.view().message(start_line(plan, domains, dir));
  if (placed) run.view().message(placed->text());
  if (page) {
    page->announce([&](const std::string& text) { run.view().message(text); },
                   options.view.browser && console.terminal);
  }
  warn_of_surroundings(domains, open_files, run);
  std::optional<SecureRun> secure;
  if (options.secure) {
    secure.emplace(plan, base_domain, out->path());
    warn_of_exposure(plan, placed.get(), run);
  }
  run.fly(base_domain, out->path(), secure ? secure->folders() : SecureFolders{}, std::move(placed));

  const results::Reports reports = results::read_reports(out->path(), plan.scenario, run.reports());
  const auto collect = [&] {
    std::vector<std::string> warnings;
    if (secure) warnings = secure->collect();
    secure.reset();  // deletes the keys before the slower steps
    return warnings;
  };
  const RunResults results{options, run.facts(), plan.scenario,
                           reports, out->path(), [&](const std::string& text) { return out->write_result(text); }};
  const auto result = write_results(results, dir, collect, console);
  if (!result) return {kExitProcessFailed, dir};
  // A user who has interrupted the run does not want to see its replay.
  if (page && !run.facts().interrupted) page->stay_as_replay(out->path(), options.view, console.err);
  return {exit_code_of(run, *result), dir};
}

}  // namespace skein::cli
