// A UAV's on-board software as a program; with `--role gcs`, a strategy's program at the ground station.
#pragma once

#include "bus/lockstep/fleet_program.hpp"
#include "core/planners/uav_planner.hpp"
#include "core/scenario/scenario_shelf.hpp"
#include "results/run_folder.hpp"
#include "uav_agent/api/learner.hpp"
#include "uav_agent/onboard/ready_frames.hpp"

namespace skein::agent {

class AgentProgram final : public bus::FleetProgram {
 public:
  /// @param frames  cache of key frames for the agents of this process; nullptr: the process has one agent.
  /// @param desk  steps this program's learner; nullptr: planners that are learners are refused.
  /// @param scenarios  of the agents of this process.
  explicit AgentProgram(std::shared_ptr<ReadyFrames> frames = nullptr, std::shared_ptr<LearnerDesk> desk = nullptr,
                        std::shared_ptr<ScenarioShelf> scenarios = std::make_shared<ScenarioShelf>())
      : frames_(std::move(frames)), desk_(std::move(desk)), scenarios_(std::move(scenarios)) {}
  const char* name() const override { return programs::kAgent; }
  void add_options(CLI::App& app) override;
  std::variant<int, std::unique_ptr<bus::FleetMember>> prepare(const ProgramOptions& options,
                                                               StatusPipe& status) override;

 private:
  std::string role_ = "uav";
  std::string uav_, planner_ = kDefaultPlanner;
  std::optional<double> maps_every_s_, pdb_from_s_;
  bool list_ = false, times_parts_ = false;
  const std::shared_ptr<ReadyFrames> frames_;
  const std::shared_ptr<LearnerDesk> desk_;
  const std::shared_ptr<ScenarioShelf> scenarios_;
};

}  // namespace skein::agent
