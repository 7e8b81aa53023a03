// One UAV's view of its XXH team: the members and their regions, the progress that the others report, and which members
// are silent, so that the team does not wait for them.
// Threads: one.   Source: paper, "Task Assignment" of Team XXH. That a UAV computes the assignment itself when it
// receives none, and that no UAV waits for silent members, is our choice: without it, a team can be idle for a whole
// mission.
#pragma once

#include "uav_agent/planners/xxh/config.hpp"
#include "uav_agent/planners/xxh/talk.hpp"

namespace skein::agent {

class XxhCrew {
 public:
  /// @param config, agent, talk  must outlive this.
  XxhCrew(const XxhConfig& config, const AgentConfig& agent, const XxhTalk& talk)
      : config_(config), agent_(agent), talk_(talk) {}

  /// Takes the station's assignment; after assignment_wait_s computes it itself, from reported and nominal starts.
  /// @param in_flight  computes it without waiting.   @returns true once, when there is an assignment.
  bool seek_assignment(const PlannerInput& in, bool in_flight);
  bool assigned() const { return !team_.members.empty(); }

  /// Whether an explorer leads the team; whether this UAV is that explorer. Call these only if assigned().
  bool led() const { return agent_.fleet[leader()].role == Role::explorer; }
  bool leads() const { return led() && leader() == agent_.self; }
  std::size_t leader() const { return team_.members.front(); }
  const std::vector<std::size_t>& members() const { return team_.members; }
  const std::vector<XxhRegion>& regions() const { return team_.regions; }
  std::size_t size() const { return team_.members.size(); }
  /// This UAV's place in members().
  std::size_t rank() const;
  /// Index of a member's section of a region's layers: the leader, which explores first, has the last one.
  std::size_t section_of(std::size_t rank) const { return rank == 0 ? size() - 1 : rank - 1; }

  /// Whether nothing was heard of a UAV for silence_s.
  bool silent(std::size_t uav, Tick now) const;
  /// The UAV that it waits for at its post: the leader; the leader itself waits for the first member not silent.
  std::size_t awaited(Tick now) const;
  /// Whether the leader has reported that this UAV's section may be inspected.
  bool ordered(std::size_t region) const;
  /// Whether all members that are not silent have acknowledged this order for their sections.
  bool all_ordered(std::size_t region, Tick now) const;
  /// Whether all members that are not silent are done with a region.
  bool all_done(std::size_t region, Tick now) const;
  /// The farthest region that another member has reported; 0 if none has.
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
