// The goals that one UAV of XXH has given to its flight core (api/goals.hpp), called choices, and their outcomes. The
// flight core flies to the first choice that it can reach.
// Frame W.   Units: SI.   Threads: one.
#pragma once

#include <optional>
#include <vector>

#include "uav_agent/api/planner.hpp"

namespace skein::agent {

class XxhErrand {
 public:
  /// End of the flight to one of the choices.
  struct End {
    std::size_t choice = 0;
    bool reached = false;  ///< the UAV rests at the end of its way; false: the way was blocked
  };

  /// Reads the outcomes of the choices. Call it once per exchange, before anything else.
  void listen(const PlannerInput& in);
  /// Gives the flight core `choices`, best first, in place of the present ones.
  void set_out(std::vector<Goal> choices, PlannerOutput& out);
  /// Drops the present choices.
  void drop();
  /// Takes choices that are left of an ended list back from the core. Call it once per exchange, after everything else.
  void conclude(PlannerOutput& out);

  /// Whether the flight core flies to one of the choices or searches a path to one.
  bool under_way() const { return under_way_; }
  /// Indices of the choices that could not be reached, by the outcomes of this exchange.
  const std::vector<std::size_t>& missed() const { return missed_; }
  /// The flight that ended in this exchange, if any.
  const std::optional<End>& ended() const { return ended_; }
  /// Whether this exchange brought the result that none of the choices can be reached.
  bool came_to_nothing() const { return !under_way_ && !ended_ && !missed_.empty(); }
  /// Index of the choice that the flight core flies to now.
  std::optional<std::size_t> flies_to(const PlannerInput& in) const;
  const Goal& choice(std::size_t i) const { return choices_[i]; }
  /// The UAV's place and the next ones on its way, to be announced to the other UAVs.
  std::vector<Vector3d> ahead(const PlannerInput& in) const;

 private:
  std::optional<std::size_t> index(std::int64_t id) const;

  std::vector<Goal> choices_;
  std::int64_t first_id_ = 0;  ///< id of the first choice
  std::int64_t next_id_ = 1;
  bool under_way_ = false;
  bool some_left_ = false;  ///< the core may have choices that it has not tried yet
  std::vector<std::size_t> missed_;
  std::optional<End> ended_;
};

}  // namespace skein::agent
