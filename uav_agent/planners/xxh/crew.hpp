// One UAV's view of its XXH team: who belongs to it, what it has to do, how far the others say they are, and who is no
// longer heard of and so no longer waited for.
// Threads: one.   Source: paper, "Task Assignment" of Team XXH. That a UAV makes the assignment itself when none comes,
// and that the silent are not waited for, is our choice: without it, a team can be idle for a whole mission.
#pragma once

#include "uav_agent/planners/xxh/config.hpp"
#include "uav_agent/planners/xxh/talk.hpp"

namespace skein::agent {

class XxhCrew {
 public:
  /// All must outlive this.
  XxhCrew(const XxhConfig& config, const AgentConfig& agent, const XxhTalk& talk)
      : config_(config), agent_(agent), talk_(talk) {}

  /// Takes the station's assignment, or after some time makes it itself: from what was reported, and nominal starts.
  /// @param in_flight  there is no time to wait.   @returns true once, when the assignment is there.
  bool seek_assignment(const PlannerInput& in, bool in_flight);
  bool assigned() const { return !team_.members.empty(); }

  /// Whether an explorer leads it at all; whether that is this UAV.
  bool led() const { return agent_.fleet[leader()].role == Role::explorer; }
  bool leads() const { return led() && leader() == agent_.self; }
  std::size_t leader() const { return team_.members.front(); }
  const std::vector<std::size_t>& members() const { return team_.members; }
  const std::vector<XxhRegion>& regions() const { return team_.regions; }
  std::size_t size() const { return team_.members.size(); }
  /// 0 for the first in the team.
  std::size_t rank() const;
  /// The part of a region's layers that is a member's: the leader's is the last one, since it explores until then.
  std::size_t section_of(std::size_t rank) const { return rank == 0 ? size() - 1 : rank - 1; }

  bool silent(std::size_t uav, Tick now) const;
  /// Whom it waits for at its post: its leader; the leader for the first of the others who can be heard.
  std::size_t awaited(Tick now) const;
  /// The leader has said that this UAV's section may be inspected.
  bool ordered(std::size_t region) const;
  /// All who can be heard know so of theirs.
  bool all_ordered(std::size_t region, Tick now) const;
  /// All who can be heard are done with a region.
  bool all_done(std::size_t region, Tick now) const;
  /// The farthest region that another member says it is at; 0 if none does.
  std::size_t farthest_region() const;

 private:
  template <class Test>
  bool all_others(std::size_t region, Tick now, const Test& test) const;

  const XxhConfig& config_;
  const AgentConfig& agent_;
  const XxhTalk& talk_;
  XxhTeam team_;
};

}  // namespace skein::agent
