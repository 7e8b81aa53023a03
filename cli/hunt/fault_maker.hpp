// Faults that nobody thought of: schedules of all kinds of faults (docs/faults.md), drawn at random, and varied. They
// know kinds, not what could be wrong with a planner. All are over in time for what must hold "after heal", but for
// some UAVs whose programs are killed for good.
// The same stream draws the same faults. Pure; any thread. Simulated seconds.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/faults/fault_plan.hpp"
#include "core/random_stream.hpp"
#include "core/scenario.hpp"

namespace skein::cli {

/// Kinds of faults, as keys of a fault file spell them.
const std::vector<std::string>& fault_kinds();

/// What schedules may be made of.
struct FaultSpace {
  std::vector<std::string> kinds = fault_kinds();  ///< not empty
  double heal_by_s = 60.0;                         ///< every fault that is ever over is so by then
  bool ground_program = false;                     ///< one runs at the ground station
};

class FaultMaker {
 public:
  /// @param scenario  must outlive this.
  FaultMaker(const Scenario& scenario, FaultSpace space);

  /// One to four faults, some of them several times.
  std::vector<Fault> schedule(RandomStream& draw) const;
  /// A schedule like another: a time, a length, a target or a strength changed, a fault more or less.
  /// @param other  whose faults may be mixed in.
  std::vector<Fault> varied(std::vector<Fault> faults, const std::vector<Fault>& other, RandomStream& draw) const;

 private:
  Fault any(RandomStream& draw) const;
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
  bool is_death(const Fault& fault) const;  ///< of a UAV's program

  const FaultSpace space_;
  std::vector<std::string> uavs_, with_lidar_, nodes_, ground_programs_, topics_;
};

/// Of two faults that take hold of the same thing at the same time the later one in the list goes.
std::vector<Fault> without_contradictions(std::vector<Fault> faults);

/// What a fault is, for who says that something does not hold with it: its kind, and a link's effects ("duplication").
std::vector<std::string> words_of(const Fault& fault);

}  // namespace skein::cli
