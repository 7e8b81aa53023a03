// Tours of several agents over tasks: a heuristic for the multiple travelling salesmen problem that minimises the
// longest tour, or the sum of all tours. Each agent begins at a place of its own and may end at any task. Construction
// by cheapest insertion: for the longest tour, the agent with the least cost so far takes the task that lengthens it
// least; for the sum, each agent first takes one task, then always the cheapest insertion of all comes next.
// Improvement: each tour is shortened on its own, and tasks move to other tours, or tours exchange tasks, as long as
// that helps.
// Pure and deterministic: ties go to the lower number; effort is bounded by a count of evaluated moves.
// Source: reconstructs the distributed mTSP of KIOS, whose paper was not available; STAR's task assignment.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/types.hpp"
#include "uav_agent/planning/tours.hpp"

namespace skein::agent {

struct FleetTourProblem {
  std::size_t agents = 1;
  /// Nodes 0 to agents - 1 are the agents' places, the others are tasks. Costs of ways to agents' places are not used.
  CostMatrix costs{1};
  std::vector<double> service = {};  ///< cost of each task itself, by task (node - agents); empty: none
  std::vector<double> ahead = {};    ///< by agent: cost before its tour begins; empty: none
};

enum class FleetTourObjective { longest, total };

constexpr std::array<EnumName<FleetTourObjective>, 2> enum_names(FleetTourObjective) {
  return {{{"longest", FleetTourObjective::longest}, {"total", FleetTourObjective::total}}};
}

struct FleetTourConfig {
  std::size_t max_evaluations = 300'000;  ///< chosen: bounds the CPU time
  /// What is minimised. For `total`, each agent gets at least one task if there are enough.
  FleetTourObjective objective = FleetTourObjective::longest;
  double total_weight = 0.02;  ///< for `longest`: weight of the sum of tours, next to the longest one; chosen
};

struct FleetTours {
  std::vector<Tour> tours;  ///< by agent: nodes of its tasks in order, without its own place
  double longest = 0.0, total = 0.0;
};

FleetTours solve_fleet_tours(const FleetTourProblem& problem, const FleetTourConfig& config = {});

/// Computes `longest` and `total` of given tours: costs of ways, `service` and `ahead`.
FleetTours measure_fleet_tours(const FleetTourProblem& problem, std::vector<Tour> tours);

}  // namespace skein::agent
