// sim_server as a program: it flies a run, or does one of the things that take its code and no fleet
// (server_tasks.hpp).
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
  /// @param gate  of whoever steps the fleet in this process; nullptr: it flies by itself.
  /// @param shelf  with the scene of its scenario; nullptr, or empty: it loads that.
  /// @param for_each  how the simulation has its work done.
  explicit ServerProgram(std::shared_ptr<StepGate> gate = nullptr, std::shared_ptr<SceneShelf> shelf = nullptr,
                         ForEach for_each = one_after_another)
      : gate_(std::move(gate)), shelf_(std::move(shelf)), for_each_(std::move(for_each)) {}
  /// Loads the scene that a server with these options will have. @throws InputError
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
  std::string watch_speed_;  ///< empty: nobody watches
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
