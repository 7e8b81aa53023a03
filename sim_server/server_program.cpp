#include "sim_server/server_program.hpp"

#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "bus/program_bus.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "core/text/number_checks.hpp"
#include "core/topics.hpp"
#include "process/files/user_cache.hpp"
#include "process/json_text.hpp"
#include "process/reports/program_report.hpp"
#include "process/status/status_lines.hpp"
#include "results/run_folder.hpp"
#include "scenes/scene_source.hpp"
#include "scenes/scene_warnings.hpp"
#include "sim_server/sim_node.hpp"

namespace skein::sim {
namespace {

std::optional<double> realtime_factor(const std::string& clock) {
  if (clock == "lockstep") return std::nullopt;
  const std::string realtime = "realtime";
  if (clock == realtime) return 1.0;
  if (clock.starts_with(realtime + ":")) {
    char* end = nullptr;
    const std::string text = clock.substr(realtime.size() + 1);
    const double factor = std::strtod(text.c_str(), &end);
    if (!text.empty() && *end == '\0' && factor > 0.0 && factor <= 1000.0) return factor;
  }
  throw InputError("--clock " + clock +
                   ": it must be lockstep, realtime or realtime:FACTOR with a factor above 0 and at most 1000");
}

std::optional<WatchOptions> watch_options(const std::string& speed, const std::string& clock, bool losses,
                                          std::optional<double> pause_at_s) {
  if (speed.empty()) return std::nullopt;
  return WatchOptions{view::read_speed(speed), !realtime_factor(clock), losses, pause_at_s};
}

std::vector<UavIndex> indices_of(const std::vector<std::string>& names, const Scenario& scenario) {
  std::vector<UavIndex> uavs;
  for (const std::string& name : names) uavs.push_back(scenario.uav_index(name));
  return uavs;
}

/// @throws InputError if a name is not that of a UAV of the fleet.
std::vector<std::string> uavs_named(const std::vector<std::string>& names, const Scenario& scenario) {
  indices_of(names, scenario);
  return names;
}

FlightReport flight_of(const ProgramOptions& options, const Scenario& scenario, const std::string& clock) {
  return {.scenario = options.scenario,
          .seed = options.seed,
          .scene_seed = scenario.scene.scene_seed,
          .uavs = scenario.fleet.size(),
          .run = static_cast<std::uint64_t>(options.run),
          .duration_s = scenario.duration_s,
          .clock = clock,
          .dds = options.dds};
}

/// @throws InputError if a run was flown in the folder. Without a launcher, the folder has not been emptied, and the
/// server would continue the records of a run with the same number.
void refuse_used_folder(const ProgramOptions& options) {
  if (options.has_launcher() || !std::filesystem::exists(options.out / run_folder::kDigests)) return;
  const std::filesystem::path file = options.out / run_folder::report_file(programs::kSimServer);
  const auto run = struct_of<SimServerReport>(read_json(file)).flight.run;
  if (run && *run != static_cast<std::uint64_t>(options.run)) return withdraw_report(file);
  throw InputError(
      "--out " + options.out.string() + ": a run was flown there" +
      (run ? " with the same number (" + std::to_string(*run) + ")" : ", and not to its end") +
      "; choose another folder, or another number of the run (--run; in a compose file SKEIN_RUN, or clear its volumes "
      "with down --volumes)");
}

class ServerMember final : public bus::FleetMember {
 public:
  ServerMember(std::unique_ptr<const Scenario> scenario, Scene scene, const SimNodeOptions& options,
               std::unique_ptr<bus::Bus> bus, StatusPipe& status, bool has_launcher)
      : scenario_(std::move(scenario)),
        has_launcher_(has_launcher),
        bus_(std::move(bus)),
        node_(*scenario_, std::move(scene), options, *bus_, status) {}

  bus::LockstepNode& node() override { return node_; }
  bus::Bus& bus() override { return *bus_; }
  std::optional<int> ended(bus::NodeEnd) override {
    return node_.summary().status == RunStatus::aborted ? kExitInterrupted : kExitDone;
  }

  bool stops_at_once() const override { return false; }
  // For an orderly end the launcher sends its own order first, so a signal aborts the run. Without a launcher, the
  // first signal ends the run in good order, and the next one aborts it.
  void on_stop() override {
    if (has_launcher_ || std::exchange(asked_to_end_, true)) return node_.abort();
    spdlog::info("asked to end: the run ends with its next step");
    node_.request_stop();
  }
  void obey(const std::string& line) override {
    const std::optional<orders::Line> order = orders::read_line(line);
    if (!order) {
      spdlog::warn("unknown order: {}", line);
    } else if (const auto* lost = std::get_if<orders::Lost>(&*order)) {
      node_.report_lost(lost->member);
    } else {
      node_.request_stop();
    }
  }

 private:
  const std::unique_ptr<const Scenario> scenario_;
  const bool has_launcher_;
  bool asked_to_end_ = false;
  const std::unique_ptr<bus::Bus> bus_;
  SimNode node_;
};

}  // namespace

void ServerProgram::add_options(CLI::App& app) {
  app.description("Skein: the world of a fleet (physics, sensors, radio links, referee, clock)");
  app.add_option("--clock", clock_, "lockstep, realtime or realtime:FACTOR");
  app.add_option("--stop-at", stop_at_s_, "End at this simulated time [s]")
      ->check(CLI::Validator(check_positive, "POSITIVE"));
  app.add_option("--agent-timeout", agent_timeout_s_, "Wall time to wait for a member's answer [s], 0: no limit")
      ->check(CLI::Validator(check_not_negative, "NONNEGATIVE"));
  app.add_option("--startup-timeout", startup_timeout_s_,
                 "Wall time to wait until all programs have joined [s], 0: no limit (default: 20 and 2 for each UAV, "
                 "or --agent-timeout if that is more)")
      ->check(CLI::Validator(check_not_negative, "NONNEGATIVE"));
  app.add_flag("--ground-program", ground_program_, "Wait for a program at the ground station before the start");
  app.add_option(
         "--watch", watch_speed_,
         "Send the station the data for the live page, and fly at this speed (SPEED or max) until the page changes it")
      ->group("Launcher");
  app.add_option("--watch-pause-at", watch_pause_at_s_,
                 "Pause at this simulated time [s] until the page resumes the run")
      ->check(CLI::Validator(check_not_negative, "NONNEGATIVE"))
      ->needs("--watch")
      ->group("Launcher");
  app.add_flag("--watch-losses", watch_losses_, "Ask the oracle for the attainable score, for the page")
      ->needs("--watch")
      ->group("Launcher");
  app.add_option("--stand-ins", stand_ins_, "UAVs whose agent passes on the messages of programs outside the lock-step")
      ->delimiter(',');
  app.add_option("--by-hand", by_hand_, "UAVs that a viewer flies by hand on the page")
      ->delimiter(',')
      ->needs("--watch")
      ->group("Launcher");
  recording::add_replay_options(app, replay_);
  tasks_.add_options(app);
}

// Each member adds DDS participants, which all others must discover: on two cores, a hundred UAVs take half a minute.
double ServerProgram::startup_timeout_s(const Scenario& scenario) const {
  if (startup_timeout_s_) return *startup_timeout_s_;
  constexpr double kPerUav_s = 2.0, kLeast_s = 20.0;  // even if the timeout for answers is short
  if (agent_timeout_s_ <= 0.0) return 0.0;            // no timeout
  return std::max(agent_timeout_s_, kLeast_s) + kPerUav_s * static_cast<double>(scenario.fleet.size());
}

Scene ServerProgram::load_ahead(const ProgramOptions& options) {
  return load_scene(load_scenario(options.scenario, options.load_options()), user_cache_folder());
}

std::variant<int, std::unique_ptr<bus::FleetMember>> ServerProgram::prepare(const ProgramOptions& options,
                                                                            StatusPipe& status) {
  if (!tasks_.golden.empty()) return tasks_.check_golden();
  if (!tasks_.export_scene.empty() || !tasks_.scene_picture.empty()) return tasks_.write_scene(options);
  auto scenario = std::make_unique<const Scenario>(load_scenario(options.scenario, options.load_options()));
  if (!tasks_.oracle.empty()) return tasks_.ask_oracle(*scenario);
  const SimNodeOptions node_options{.base_domain = options.domain,
                                    .out = options.out,
                                    .seed = options.seed,
                                    .realtime_factor = realtime_factor(clock_),
                                    .stop_at_s = stop_at_s_,
                                    .agent_timeout_s = agent_timeout_s_,
                                    .startup_timeout_s = startup_timeout_s(*scenario),
                                    .flight = flight_of(options, *scenario, clock_),
                                    .record = recording::scope_of(options.record),
                                    .replay = replay_,
                                    .notice_deaths = !options.has_launcher(),
                                    .expect_gcs_program = ground_program_,
                                    .watch = watch_options(watch_speed_, clock_, watch_losses_, watch_pause_at_s_),
                                    .stand_ins = uavs_named(stand_ins_, *scenario),
                                    .by_hand = indices_of(by_hand_, *scenario),
                                    .faults = load_fault_plan(options.faults, *scenario, options.seed),
                                    .gate = gate_,
                                    .for_each = for_each_};
  std::optional<Scene> ready = shelf_ ? shelf_->take() : std::nullopt;
  Scene scene = ready ? std::move(*ready) : load_scene(*scenario, user_cache_folder());
  if (!options.check_only) {
    options.check_out();
    refuse_used_folder(options);
  }
  auto bus = bus::make_bus(options, *scenario, domain_names(*scenario).size());
  if (options.check_only) {
    for (const std::string& warning : scene_warnings(scene)) spdlog::warn("{}", warning);
    const Simulation checked(*scenario, std::move(scene), options.seed);  // checks that the starts are free
    return kExitDone;
  }
  return std::make_unique<ServerMember>(std::move(scenario), std::move(scene), node_options, std::move(bus), status,
                                        options.has_launcher());
}

}  // namespace skein::sim
