// The history of a UAV's link to the station: when and where it had a link, and whether captures arrive.
// Frame W.   Units: SI.   Threads: one.   Bounded: one place for each 8 m of the way, along each axis.
#pragma once

#include <array>
#include <map>
#include <optional>

#include "uav_agent/api/planner.hpp"

namespace skein::agent {

class LinkWatch {
 public:
  /// Call it once per exchange while the UAV is airborne.
  void update(const PlannerInput& in);
  /// Whether update() was called at least once.
  bool begun() const { return delivered_at_.has_value(); }
  /// Whether captures taken here are delivered. With a link: a capture was delivered, or none was waiting, within the
  /// last 5 s. Without a link: none is waiting, and the link was lost less than 1 s ago.
  bool delivers_here(const PlannerInput& in) const;
  /// How long captures have been waiting without a break [s]; 0: none is waiting. Only if begun().
  double waited_s(const PlannerInput& in) const;
  /// Where the UAV last had a link that lasted 1 s: its setpoint at least 1 s before that link's end, or before now.
  const std::optional<Vector3d>& linked_at_W() const { return linked_at_W_; }
  /// The nearest one to p_W of all places like linked_at_W(); one is kept in each cube of 8 m. nullopt: there is none.
  std::optional<Vector3d> linked_near_W(const Vector3d& p_W) const;

 private:
  void note_link(const PlannerInput& in);

  struct Sighting {
    Tick tick = 0;
    Vector3d p_WB = Vector3d::Zero();
  };
  std::optional<Tick> delivered_at_;  ///< last tick without undelivered captures, or the first tick
  std::optional<Tick> arrived_at_;    ///< last tick at which a capture was delivered, or none was waiting
  std::optional<Tick> linked_at_;     ///< last tick with a link
  std::size_t undelivered_ = 0;       ///< in the last exchange
  std::optional<Sighting> sighting_;  ///< the last one noted in the present link
  std::optional<Vector3d> linked_at_W_;
  std::map<std::array<int, 3>, Vector3d> linked_W_;  ///< by cube: the last such place in it
};

}  // namespace skein::agent
