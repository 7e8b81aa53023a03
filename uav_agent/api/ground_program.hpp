// The program of a strategy at the ground station; not every strategy has one. It receives radio messages, knows which
// UAVs are in line of sight of the station, and answers by radio. It flies nothing. It is registered under the name of
// the strategy's planner, and takes the same parameters.
//
// Deterministic, as a planner is: its output may depend only on its present and past inputs.
// Frame W.   Units: SI.   Threads: one program is used by one thread.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/scenario/scenario.hpp"
#include "uav_agent/api/agent_config.hpp"
#include "uav_agent/api/messages.hpp"
#include "uav_agent/api/strategy_registry.hpp"

namespace skein::agent {

struct GroundInput {
  std::uint64_t k = 0;  ///< number of the exchange
  Tick tick = 0;
  std::vector<OrientedBox> boxes;             ///< empty until received
  std::vector<Neighbour> linked;              ///< UAVs in line of sight in this exchange
  std::optional<double> mission_remaining_s;  ///< nullopt before the first takeoff of the fleet
  std::vector<RadioMessage> radio;            ///< received in this exchange
};

class GroundProgram {
 public:
  virtual ~GroundProgram() = default;
  /// Called once per exchange, also before takeoff. @returns messages to send, on topics on which the scenario lets
  /// "gcs" send ("/plan" always). Others are dropped.
  virtual std::vector<RadioMessage> work(const GroundInput& input) = 0;
};

/// @param spec    as make_planner() takes it: "xxh", "xxh:voxel=4", "xxh:params.yaml".
/// @param ground  what ground_config() returns.
/// @throws InputError for a strategy that has no program at the ground station (those that have are listed), and for
///   parameters that it does not take.
std::unique_ptr<GroundProgram> make_ground_program(const std::string& spec, const AgentConfig& ground);

/// Names of the strategies that have a program at the ground station, sorted.
std::vector<std::string> ground_program_names();

/// What the ground station knows before the flight: as agent_config(), but `self` is fleet.size(), which is not a UAV,
/// and `vehicle` is a default one.
AgentConfig ground_config(const Scenario& scenario);

}  // namespace skein::agent

/// Registers a strategy's program at the ground station, as SKEIN_REGISTER_PLANNER does its planner.
#define SKEIN_REGISTER_GROUND_PROGRAM(name, Class) SKEIN_REGISTER_STRATEGY(GroundProgram, name, Class)
