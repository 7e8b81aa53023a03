// How long a photographer of KIOS waits for the explorers' map: until one says that it is done and none in sight that
// it is not; or until none was seen to fly for a while, or it has waited for wait_s: then it works with what is mapped.
// Whoever comes back may have missed that word while explorers are out of its sight: it believes photographers that
// work.
// Threads: one.   Source: paper (photographers idle while the explorers map); that it ends is ours.
#pragma once

#include "uav_agent/planners/kios/config.hpp"
#include "uav_agent/planners/kios/talk.hpp"

namespace skein::agent {

class KiosPatience {
 public:
  /// Both must outlive this.
  KiosPatience(const AgentConfig& agent, const KiosTalk& talk) : agent_(agent), talk_(talk) {}

  void begin(Tick now) { since_ = now; }
  /// To be told when the program was away.
  void came_back() { came_back_ = true; }
  /// Once per exchange of waiting.
  bool is_over(const PlannerInput& in, const KiosConfig& config);

 private:
  const AgentConfig& agent_;
  const KiosTalk& talk_;
  Tick since_ = 0, seen_flying_ = 0;  ///< the latter: any explorer
  bool came_back_ = false;
};

}  // namespace skein::agent
