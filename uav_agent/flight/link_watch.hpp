// What a UAV knows of its link to the station: when it had one, where, and whether captures arrive.
// Frame W.   Units: SI.   Threads: one.
#pragma once

#include <optional>

#include "uav_agent/api/planner.hpp"

namespace skein::agent {

class LinkWatch {
 public:
  /// Once per exchange in the air.
  void update(const PlannerInput& in);
  /// It was told of an exchange.
  bool begun() const { return delivered_at_.has_value(); }
  /// What is taken here arrives, one by one on a poor link. A link that has just gone may be back, where nothing waits
  /// for it.
  bool delivers_here(const PlannerInput& in) const;
  /// Whether something has been undelivered for longer than that; only once begun().
  bool waits_for_longer_than(double time_s, const PlannerInput& in) const;
  /// Where it last had a link for a while, and somewhat before that ended.
  const std::optional<Vector3d>& linked_at_W() const { return linked_at_W_; }

 private:
  void note_link(const PlannerInput& in);

  struct Sighting {
    Tick tick = 0;
    Vector3d p_WB = Vector3d::Zero();
  };
  std::optional<Tick> delivered_at_;  ///< when nothing was undelivered
  std::optional<Tick> arrived_at_;    ///< when a capture last was delivered, or none was to be
  std::optional<Tick> linked_at_;     ///< when it last had a link
  std::size_t undelivered_ = 0;       ///< in the last exchange
  std::optional<Sighting> sighting_;  ///< of the station, in the present link
  std::optional<Vector3d> linked_at_W_;
};

}  // namespace skein::agent
