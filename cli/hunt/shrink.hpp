// Makes a find small: what can be taken away of it while the same property fails goes. The order of what is tried, and
// so the result, does not depend on how many flights are flown at once. Pure, but for the flights.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/hunt/trial.hpp"
#include "core/scenario.hpp"

namespace skein::cli {

/// Flies these, in any order, and tells what came of each.
using FlyTrials = std::function<std::vector<TrialOutcome>(const std::vector<Trial>&)>;

struct Shrunk {
  Trial trial;
  TrialOutcome outcome;
  std::size_t flights = 0;  ///< that it took
};

/// Something simpler than a trial.
struct Proposal {
  std::string
      what;  ///< was done to it: one that is refused is not tried again as long as faults and fleet are the same
  Trial trial;
};

/// What is tried of a find, what saves most first: a shorter mission, which makes all that follows cheaper; faults
/// fewer, by halves before one by one; fewer UAVs, no draws of the seed, a planner without parameters, a simpler scene;
/// faults shorter, weaker, at rounder times.
/// @param after_s  that the mission lasts beyond the last fault: else what must hold then would fail of itself. None:
///   it may end when the failure was seen.
std::vector<Proposal> simpler(const Trial& trial, const TrialOutcome& outcome, const std::string& property,
                              const Scenario& scenario, std::optional<double> after_s);

struct ShrinkOptions {
  std::optional<double> after_s = 0.0;  ///< see simpler()
  std::size_t at_once = 1;              ///< trials that `fly` gets in one call
  std::size_t most = 60;                ///< flights that count
};

/// @param outcome   of the trial, in which `property` fails.
/// @param scenario  of the trial, with its whole fleet.
Shrunk shrink(const Trial& trial, const TrialOutcome& outcome, const std::string& property, const Scenario& scenario,
              const ShrinkOptions& options, const FlyTrials& fly);

}  // namespace skein::cli
