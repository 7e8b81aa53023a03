// How long a UAV takes from place to place: starts, views, and from views to where its pictures reach the station.
// Units: SI.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "core/scene.hpp"
#include "sim_server/plan/team.hpp"
#include "sim_server/plan/views.hpp"
#include "sim_server/plan/ways.hpp"

namespace skein::sim {

inline constexpr double kNever = std::numeric_limits<double>::infinity();

/// Places are numbered: first all views, then the end of each UAV's take-off. All ways are by the true scene; the radio
/// is, too, without UAVs in the way. Remembers what it was asked; not thread-safe.
class Legs {
 public:
  /// All must outlive this.
  Legs(const Scenario& scenario, const RayScene& world, const Eigen::AlignedBox3d& structure, const Team& team,
       const std::vector<View>& views, const PlanConfig& config);

  std::size_t start_of(UavIndex uav) const { return views_.size() + static_cast<std::size_t>(uav); }
  /// From the first command to the end of the take-off; kNever where the scene leaves no room for one [s].
  double takeoff_s(UavIndex uav) const { return takeoff_s_[uav]; }

  /// From rest at a place to the picture at a view, the turn of the camera and the picture included; kNever where there
  /// is no way [s].
  double leg_s(std::size_t from, std::size_t to);
  /// The same if nothing were in the way: never more than leg_s(). Cheap.
  double least_leg_s(std::size_t from, std::size_t to) const;
  /// From a view to where a UAV is linked to the station; 0 where it is at the view, kNever where it cannot get to [s].
  double tail_s(std::size_t view);

  /// Corners of the way, the last one being the view; empty where there is none.
  std::vector<Vector3d> way(std::size_t from, std::size_t to);
  /// Corners of the way to where it is linked; empty where it is or where there is none.
  std::vector<Vector3d> tail(std::size_t view);
  /// How long the camera takes to turn [s].
  double turn_s(std::size_t from, std::size_t to) const;

  /// Whether a UAV of a kind is linked to the station from a place: sight of the antennas, and range.
  bool linked(std::size_t kind, const Vector3d& p_WB) const;
  const Vector3d& place(std::size_t i) const { return places_[i]; }
  std::size_t kind(std::size_t place) const { return kinds_[place]; }

 private:
  const std::vector<std::size_t>& anchors(std::size_t place);
  const std::vector<std::uint8_t>& linked_nodes(std::size_t kind);
  double flight_s(std::size_t kind, const Vector3d& from_W, const std::vector<Vector3d>& corners) const;
  std::optional<std::size_t> linked_node_for(std::size_t view);

  const Scenario& scenario_;
  const RayScene& world_;
  const Team& team_;
  const std::vector<View>& views_;
  double picture_s_;  ///< at each view
  std::vector<Vector3d> places_;
  std::vector<std::size_t> kinds_;  ///< by place
  std::vector<double> takeoff_s_;   ///< by UAV
  std::vector<Ways> ways_;          ///< by kind
  std::vector<std::vector<std::uint8_t>> linked_nodes_;
  std::vector<std::optional<std::vector<std::size_t>>> anchors_;  ///< by place
  std::unordered_map<std::uint64_t, double> flights_;             ///< by pair of places; only ever looked up
  std::vector<double> tails_;                                     ///< by view; negative: not asked yet
};

}  // namespace skein::sim
