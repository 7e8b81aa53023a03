// What a strategy has at the ground station, if it has anything there: a program that hears the radio, sees which UAVs
// are in line of sight, and answers by radio. It flies nothing. The registry finds it by the strategy's name; it takes
// the same parameters as the planner of that name.
//
// Pure, as a planner is: what it returns may depend only on its inputs and its own past.
// Frame W.   Units: SI.   Threads: one program is used by one thread.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/scenario.hpp"
#include "uav_agent/api/agent_config.hpp"
#include "uav_agent/api/messages.hpp"
#include "uav_agent/api/strategy_registry.hpp"

namespace skein::agent {

struct GroundInput {
  std::uint64_t k = 0;  ///< exchange
  Tick tick = 0;
  std::vector<OrientedBox> boxes;             ///< empty until received
  std::vector<Neighbour> linked;              ///< UAVs in line of sight at this step
  std::optional<double> mission_remaining_s;  ///< nullopt before the first take-off
  std::vector<RadioMessage> radio;            ///< received at this step
};

class GroundProgram {
 public:
  virtual ~GroundProgram() = default;
  /// Called once per exchange, also before take-off. @returns what it sends, on topics that the scenario lets "gcs"
  /// send on ("/plan" always).
  virtual std::vector<RadioMessage> work(const GroundInput& input) = 0;
};

/// @param spec    as make_planner() takes it: "xxh", "xxh:voxel=4", "xxh:params.yaml".
/// @param ground  of ground_config().
/// @throws InputError for a strategy that has no program at the ground station (those that have are listed), and for
///   parameters that it does not take.
std::unique_ptr<GroundProgram> make_ground_program(const std::string& spec, const AgentConfig& ground);

/// Strategies that have one, sorted.
std::vector<std::string> ground_program_names();

/// What is known at the ground station before anybody flies: as agent_config(), but `self` is nobody.
AgentConfig ground_config(const Scenario& scenario);

}  // namespace skein::agent

/// Registers a strategy's program at the ground station, as SKEIN_REGISTER_PLANNER does its planner.
#define SKEIN_REGISTER_GROUND_PROGRAM(name, Class) SKEIN_REGISTER_STRATEGY(GroundProgram, name, Class)
