// Creates the programs of a fleet in this process, by their names in a run ("uav_agent-jurong").
#pragma once

#include <memory>
#include <string>

#include "comm_router/router_program.hpp"
#include "results/run_folder.hpp"
#include "sim_server/server_program.hpp"
#include "station/station_program.hpp"
#include "uav_agent/agent_program.hpp"

namespace skein::one_process {

/// More key frames than a large fleet receives in a step.
inline constexpr std::size_t kFramesRemembered = 256;

/// The objects that the programs share. Desk, gate, score and shelf belong to the owner of a stepped fleet; null: the
/// fleet is not stepped.
struct FleetPrograms {
  std::shared_ptr<agent::ReadyFrames> frames = std::make_shared<agent::ReadyFrames>(kFramesRemembered);
  std::shared_ptr<ScenarioShelf> scenarios = std::make_shared<ScenarioShelf>();  ///< for the agents
  std::shared_ptr<agent::LearnerDesk> desk = {};
  std::shared_ptr<sim::StepGate> gate = {};
  std::shared_ptr<station::ScoreView> score = {};
  std::shared_ptr<sim::SceneShelf> shelf = {};
  ForEach for_each = one_after_another;  ///< how the server runs its loops: one after another, or in parallel

  std::unique_ptr<bus::FleetProgram> make(const std::string& name) const {
    if (name == programs::kSimServer) return std::make_unique<sim::ServerProgram>(gate, shelf, for_each);
    if (name == programs::kCommRouter) return std::make_unique<router::RouterProgram>();
    if (name == programs::kStation) return std::make_unique<station::StationProgram>(score);
    return std::make_unique<agent::AgentProgram>(frames, desk, scenarios);
  }
};

}  // namespace skein::one_process
