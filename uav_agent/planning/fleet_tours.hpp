// Tours of several agents over tasks: a heuristic for the multiple travelling salesmen problem that makes the longest
// tour as short as possible, or the sum of all. Everybody begins elsewhere and ends anywhere. For the longest tour,
// whoever has least to do takes the task that lengthens its tour least (cheapest insertion); for the sum, first each
// takes one task, as the problem has it, then the cheapest insertion of all comes next. Then every tour is shortened on
// its own, and tasks move to other tours or change places with theirs, as long as that helps.
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
  /// Nodes 0 to agents - 1 are where the agents are, the others are tasks. Ways to an agent's node are not used.
  CostMatrix costs{1};
  std::vector<double> service = {};  ///< cost of each task itself, by task (node - agents); empty: none
  std::vector<double> ahead = {};    ///< cost that each agent has before it begins; empty: none
};

enum class FleetTourObjective { longest, total };

constexpr std::array<EnumName<FleetTourObjective>, 2> enum_names(FleetTourObjective) {
  return {{{"longest", FleetTourObjective::longest}, {"total", FleetTourObjective::total}}};
}

struct FleetTourConfig {
  std::size_t max_evaluations = 300'000;
  /// What is to be short. For `total`, nobody stays without a task where there is one for each.
  FleetTourObjective objective = FleetTourObjective::longest;
  double total_weight = 0.02;  ///< of the sum of all tours beside the longest one
};

struct FleetTours {
  std::vector<Tour> tours;  ///< by agent: nodes of its tasks in the order of visit
  double longest = 0.0, total = 0.0;
};

FleetTours solve_fleet_tours(const FleetTourProblem& problem, const FleetTourConfig& config = {});

/// longest and total of given tours, as solve_fleet_tours() counts them.
FleetTours measure_fleet_tours(const FleetTourProblem& problem, std::vector<Tour> tours);

}  // namespace skein::agent
