// sim_server as a program: it simulates the world of a run, or does a task that needs its code but no fleet
// (server_tasks.hpp).   Units: s.   Threads: one.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bus/lockstep/fleet_program.hpp"
#include "core/for_each.hpp"
#include "recording/replay.hpp"
#include "results/run_folder.hpp"
#include "sim_server/scene_shelf.hpp"
#include "sim_server/server_tasks.hpp"
#include "sim_server/step_gate.hpp"

namespace skein::sim {

class ServerProgram final : public bus::FleetProgram {
 public:
  /// @param gate  lets this process step the fleet; nullptr: the run advances by itself.
  /// @param shelf  holds the scene of the scenario; nullptr, or empty: the server loads the scene.
  /// @param for_each  executes work of the simulation that can be shared among threads.
  explicit ServerProgram(std::shared_ptr<StepGate> gate = nullptr, std::shared_ptr<SceneShelf> shelf = nullptr,
                         ForEach for_each = one_after_another)
      : gate_(std::move(gate)), shelf_(std::move(shelf)), for_each_(std::move(for_each)) {}
  /// Loads the scene that a server with these options would load. @throws InputError
  static Scene load_ahead(const ProgramOptions& options);
  const char* name() const override { return programs::kSimServer; }
  void add_options(CLI::App& app) override;
  std::variant<int, std::unique_ptr<bus::FleetMember>> prepare(const ProgramOptions& options,
                                                               StatusPipe& status) override;

 private:
  double startup_timeout_s(const Scenario& scenario) const;

  std::string clock_ = "lockstep";
  std::optional<double> stop_at_s_, startup_timeout_s_;
  double agent_timeout_s_ = 60.0;
  bool ground_program_ = false;
  std::string watch_speed_;  ///< empty: the run is not watched
  bool watch_losses_ = false;
  std::optional<double> watch_pause_at_s_;
  std::vector<std::string> by_hand_, stand_ins_;
  recording::ReplayOptions replay_;
  ServerTasks tasks_;
  const std::shared_ptr<StepGate> gate_;
  const std::shared_ptr<SceneShelf> shelf_;
  const ForEach for_each_;
};

}  // namespace skein::sim
