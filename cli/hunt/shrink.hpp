// Minimises a find: simplifies its trial as long as the same property fails. The order of the attempts, and so the
// result, does not depend on how many trials fly at once. Pure, except for the flights.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/hunt/trial.hpp"
#include "core/scenario/scenario.hpp"

namespace skein::cli {

/// Flies these trials, in any order. @returns their outcomes, in the order of the trials.
using FlyTrials = std::function<std::vector<TrialOutcome>(const std::vector<Trial>&)>;

struct Shrunk {
  Trial trial;
  TrialOutcome outcome;
  std::size_t flights = 0;  ///< flights that minimising took
};

/// A simpler version of a trial.
struct Proposal {
  /// Name of the simplification. If the property holds in the simplified trial, shrink() tries a simplification of this
  /// name again only after the number of faults or UAVs has changed.
  std::string what;
  Trial trial;
};

/// The simplifications of a trial, most effective first:
/// - a shorter mission, which makes all further flights cheaper;
/// - fewer faults: first without half of them, then without single ones;
/// - fewer UAVs, seed 0, fewer conditions, a simpler scene, a planner without parameters;
/// - for each fault: no condition to wait for, a shorter duration, a weaker effect, rounder times.
/// @param after_s  time that the mission must go on after its last fault [s]: some properties judge the time after the
///   faults, and would fail in any shorter mission. nullopt: the mission may end once the failure has been seen.
std::vector<Proposal> simpler(const Trial& trial, const TrialOutcome& outcome, const std::string& property,
                              const Scenario& scenario, std::optional<double> after_s);

struct ShrinkOptions {
  std::optional<double> after_s = 0.0;  ///< see simpler()
  std::size_t at_once = 1;              ///< number of trials in one call of `fly`
  std::size_t most = 60;                ///< limit of Shrunk::flights; those of a batch after its first success are free
};

/// Minimises a trial. @param outcome  of the trial, in which `property` fails. @param scenario  with its whole fleet.
Shrunk shrink(const Trial& trial, const TrialOutcome& outcome, const std::string& property, const Scenario& scenario,
              const ShrinkOptions& options, const FlyTrials& fly);

}  // namespace skein::cli
