#include "cli/fleet_command.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <csignal>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <vector>

#include "cli/flight_options.hpp"
#include "cli/option_checks.hpp"
#include "core/files/write_whole.hpp"
#include "core/text/text.hpp"
#include "core/types.hpp"
#include "host/preflight.hpp"
#include "process/files/nowhere.hpp"
#include "process/program.hpp"
#include "run/fleet_plan.hpp"
#include "run/fleet_programs.hpp"
#include "run/run_options.hpp"

namespace skein::cli {
namespace {

/// Killing or pausing a program needs a launcher that restarts it, and files that keep its state; here is neither.
void check_faults(const FaultPlan& faults) {
  for (const Fault& fault : faults.faults) {
    if (!std::holds_alternative<Kill>(fault.action) && !std::holds_alternative<Pause>(fault.action)) continue;
    throw InputError(faults.file.string() +
                     ": a fleet that is stepped takes no faults that kill or pause programs; "
                     "fly them with `skein run`");
  }
}

/// The session plan that the fleet's process gets (one_process/session.hpp).
nlohmann::json session_plan(const FleetPlan& plan) {
  nlohmann::json programs = nlohmann::json::array(), uavs = nlohmann::json::array();
  for (const ProgramSpec& program : fleet_programs(plan, kFirstDomain, kNowhere)) {
    programs.push_back({{"program", program.name}, {"argv", program.argv}});
  }
  for (const UavConfig& uav : plan.scenario.fleet) {
    uavs.push_back({{"name", uav.name}, {"role", name_of(uav.vehicle.role)}});
  }
  return {{"programs", programs},
          {"uavs", plan.scenario.uav_names()},
          {"about",
           {{"scenario", plan.scenario.name},
            {"file", std::filesystem::absolute(plan.scenario.file)},
            {"uavs", uavs},
            {"duration_s", plan.scenario.duration_s},
            {"exchange_period_s", seconds(plan.scenario.exchange_ticks())}}}};
}

/// Writes an anonymous file (memfd). @returns the path under which the program that replaces this one finds it.
std::string file_with(const std::string& text) {
  const int file = ::memfd_create("skein-session", 0);
  if (file < 0 || !write_whole(file, text)) {
    throw std::system_error(errno, std::generic_category(), "memfd");
  }
  return "/proc/self/fd/" + std::to_string(file);
}

[[noreturn]] void become(const ProgramSpec& program) {
  std::vector<char*> argv, env;
  for (const std::string& word : program.argv) argv.push_back(const_cast<char*>(word.c_str()));
  for (const std::string& entry : program.env) env.push_back(const_cast<char*>(entry.c_str()));
  argv.push_back(nullptr);
  env.push_back(nullptr);
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::execve(argv[0], argv.data(), env.data());
  throw std::system_error(errno, std::generic_category(), argv[0]);
}

}  // namespace

void add_fleet(CLI::App& app, FleetOptions& fleet) {
  RunOptions& run = fleet.run;
  CLI::App* command = app.add_subcommand(
      "fleet", "Fly a fleet that another program advances step by step; skein.Fleet in Python starts this command");
  command->add_option("SCENARIO", run.scenario, "A name under config/scenarios/ or a YAML file")->capture_default_str();
  command->add_option("--planner", run.planner, "As for `skein run`; UAV=learner: the other program commands this UAV")
      ->capture_default_str();
  const CLI::Validator seconds(check_seconds, "");
  add_mission(*command, run, "; kill and pause are refused");
  command->add_option("--stop-at", run.stop_at_s, "End the run at this simulated time [s]")->check(seconds);
  command
      ->add_option("--agent-timeout", run.agent_timeout_s,
                   "Wall time that a program may take for one step; then Skein ends the fleet [s] (default 60)")
      ->check(CLI::Validator(check_timeout, ""));
  add_programs(*command, run);
  command->add_option("--session", fleet.session, "Descriptor of the open socket to the program that steps the fleet")
      ->required();
  command->footer("See docs/how-to-python.md.");
}

int step_fleet(const FleetOptions& options, const Console& console) {
  if (options.session <= STDERR_FILENO || ::fcntl(options.session, F_GETFD) < 0) {
    throw InputError("--session " + std::to_string(options.session) +
                     ": there is no such descriptor; `skein fleet` is for skein.Fleet in Python, not for people");
  }
  RunOptions run = options.run;
  run.one_process = run.stepped = true;
  run.record = "none";
  FleetPlan plan = plan_fleet(run, program_dir());
  plan.run = draw_run_id();
  check_faults(plan.faults);
  if (run.check) {
    const ScratchDir scratch;
    run_checks(check_programs(plan, scratch.path()),
               [&](const std::string& waiting) { console.err << waiting << std::endl; });
  }
  ProgramSpec process = shared_process(plan, kNowhere);
  process.argv = {process.argv.front(), "--session", std::to_string(options.session), "--plan",
                  file_with(session_plan(plan).dump())};
  if (run.agent_timeout_s) process.argv.insert(process.argv.end(), {"--agent-timeout", shortest(*run.agent_timeout_s)});
  become(process);
}

}  // namespace skein::cli
