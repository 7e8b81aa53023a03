// Draws random schedules of all kinds of faults (docs/faults.md), and varies schedules. It has no knowledge of what
// could be wrong with a planner. All faults end early enough for properties that must hold "after heal", except that
// some programs of UAVs are killed for good.
// The same stream draws the same faults. Pure; any thread. Times in simulated seconds.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/faults/fault_plan.hpp"
#include "core/math/random_stream.hpp"
#include "core/scenario/scenario.hpp"

namespace skein::cli {

/// Kinds of faults, as keys of a fault file spell them.
const std::vector<std::string>& fault_kinds();

/// What a schedule may contain.
struct FaultSpace {
  std::vector<std::string> kinds = fault_kinds();  ///< not empty
  double heal_by_s = 60.0;                         ///< all faults end by then, except kills for good
  bool ground_program = false;                     ///< whether an agent program runs at the ground station
};

class FaultMaker {
 public:
  /// Draws faults for runs under the scenario's own conditions.
  FaultMaker(const Scenario& scenario, FaultSpace space);
  /// @param conditions  as `--conditions` has them; empty: the scenario's own.
  /// @returns a FaultMaker for runs under these conditions.
  FaultMaker under(const std::string& conditions) const;

  /// Draws one to four faults, and repeats some of them; at most six in all. None if no kind of the space is possible
  /// under the conditions.
  std::vector<Fault> schedule(RandomStream& draw) const;
  /// Varies a schedule: changes a time, length, target or strength, or adds or removes a fault.
  /// @param other  a schedule from which a fault may be added.
  std::vector<Fault> varied(std::vector<Fault> faults, const std::vector<Fault>& other, RandomStream& draw) const;

 private:
  std::optional<Fault> any_fault(RandomStream& draw) const;
  FaultAction action(const std::string& kind, RandomStream& draw) const;
  LinkEffect link(RandomStream& draw) const;
  void repeat(std::vector<Fault>& faults, RandomStream& draw) const;
  void place(Fault& fault, RandomStream& draw) const;
  void vary_one(std::vector<Fault>& faults, const std::vector<Fault>& other, RandomStream& draw) const;
  void end_in_time(Fault& fault) const;
  std::optional<FaultCondition> condition(RandomStream& draw) const;
  const std::string& uav(RandomStream& draw) const;
  const std::string& node(RandomStream& draw) const;
  const std::string& program(RandomStream& draw) const;
  bool kills_uav_program(const Fault& fault) const;

  const FaultSpace space_;
  const ConditionsConfig scenarios_conditions_;
  ConditionsConfig conditions_;  ///< of the runs
  double shortest_s_;            ///< shortest duration: an exchange begins in it, so that the fault acts
  std::vector<std::string> uavs_, with_lidar_, nodes_, ground_programs_, topics_;
};

/// Removes each fault that holds the same resource (held_by()) at the same time as an earlier one in the list.
std::vector<Fault> without_contradictions(std::vector<Fault> faults);

/// The words by which a property can exclude a fault (NamedProperty::not_with): its kind, and for a link also the keys
/// of its effect ("duplication").
std::vector<std::string> words_of(const Fault& fault);

}  // namespace skein::cli
