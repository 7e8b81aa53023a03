// What one UAV of XXH has asked its flight core to fly to (api/goals.hpp), and what became of it: a list of choices, of
// which the first that can be reached is flown to.
// Frame W.   Units: SI.   Threads: one.
#pragma once

#include <optional>
#include <vector>

#include "uav_agent/api/planner.hpp"

namespace skein::agent {

class XxhErrand {
 public:
  /// One of the choices was flown to.
  struct End {
    std::size_t choice = 0;
    bool reached = false;  ///< it rests at the end of its way; else something stands on that
  };

  /// Once per exchange, before anything else: hears what became of the choices.
  void listen(const PlannerInput& in);
  /// Sets out for the first of `choices` that can be reached, in place of what it was about.
  void set_out(std::vector<Goal> choices, PlannerOutput& out);
  /// Wants nothing of it any more.
  void drop();
  /// Once per exchange, after everything else: what is left of a list that came to an end is not flown to.
  void conclude(PlannerOutput& out);

  /// It flies to one of the choices, or looks for a way.
  bool under_way() const { return under_way_; }
  /// Choices that turned out in this exchange to be out of reach, in their order.
  const std::vector<std::size_t>& missed() const { return missed_; }
  /// In this exchange.
  const std::optional<End>& ended() const { return ended_; }
  /// There was no way to any of them: in this exchange.
  bool came_to_nothing() const { return !under_way_ && !ended_ && !missed_.empty(); }
  /// The one it flies to.
  std::optional<std::size_t> flies_to(const PlannerInput& in) const;
  const Goal& choice(std::size_t i) const { return choices_[i]; }
  /// Where it is, and the places that come next: what is shared with the others.
  std::vector<Vector3d> ahead(const PlannerInput& in) const;

 private:
  std::optional<std::size_t> index(std::int64_t id) const;

  std::vector<Goal> choices_;
  std::int64_t first_id_ = 0;  ///< of the choices
  std::int64_t next_id_ = 1;
  bool under_way_ = false;
  bool some_left_ = false;  ///< the core may hold choices that it has not tried
  std::vector<std::size_t> missed_;
  std::optional<End> ended_;
};

}  // namespace skein::agent
