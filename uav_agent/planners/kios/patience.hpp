// How long a photographer of KIOS waits for the explorers' map: until one explorer reports that it has finished mapping
// and none in sight reports that it is still mapping; or until no explorer was seen flying for silence_s, or the wait
// has lasted wait_s. Then it works with the map it has. A photographer whose program comes back may have missed the
// explorers' reports: it also takes a photographer that flies to a stop as proof that mapping has finished.
// Threads: one.   Source: paper (photographers idle while the explorers map); the end of the wait is our addition.
#pragma once

#include "uav_agent/planners/kios/config.hpp"
#include "uav_agent/planners/kios/talk.hpp"

namespace skein::agent {

class KiosPatience {
 public:
  /// @param agent, talk  must outlive this.
  KiosPatience(const AgentConfig& agent, const KiosTalk& talk) : agent_(agent), talk_(talk) {}

  void begin(Tick now) { since_ = now; }
  /// Call it when the program has come back after a fault.
  void came_back() { came_back_ = true; }
  /// Whether the wait is over, also if the fleet has no other explorer. Call it in each exchange of the wait.
  bool is_over(const PlannerInput& in, const KiosConfig& config);

 private:
  const AgentConfig& agent_;
  const KiosTalk& talk_;
  Tick since_ = 0, seen_flying_ = 0;  ///< seen_flying_: when any explorer was last seen flying
  bool came_back_ = false;
};

}  // namespace skein::agent
