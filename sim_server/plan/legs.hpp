// Flight times of a UAV between places: from starts to views, between views, and from views to places where its
// pictures reach the station.   Frame: W.   Units: SI.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "core/scenario/scene.hpp"
#include "sim_server/plan/team.hpp"
#include "sim_server/plan/views.hpp"
#include "sim_server/plan/ways.hpp"

namespace skein::sim {

inline constexpr double kNever = std::numeric_limits<double>::infinity();

/// Places are numbered: first all views, then the end of each UAV's takeoff. Paths and radio links are computed in the
/// true scene; UAVs do not block links. Caches its results; not thread-safe.
class Legs {
 public:
  /// All must outlive this.
  Legs(const Scenario& scenario, const RayScene& world, const Eigen::AlignedBox3d& structure, const Team& team,
       const std::vector<View>& views, const PlanConfig& config);

  std::size_t start_of(UavIndex uav) const { return views_.size() + static_cast<std::size_t>(uav); }
  /// Time from the first command to the end of the takeoff [s]; kNever if the structure is in the way.
  double takeoff_s(UavIndex uav) const { return takeoff_s_[uav]; }

  /// Time from rest at a place until the picture at a view is taken, the turn of the camera included [s]; kNever if
  /// there is no path.
  double leg_s(std::size_t from, std::size_t to);
  /// Lower bound of leg_s(), for a straight line without obstacles. Cheap.
  double least_leg_s(std::size_t from, std::size_t to) const;
  /// Time from a view to a place with a link to the station [s]; 0 if the view has a link, kNever if none is reachable.
  double tail_s(std::size_t view);

  /// Corners of the path, without `from`; the last one is `to`. Empty if there is no path.
  std::vector<Vector3d> way(std::size_t from, std::size_t to);
  /// Corners of the path from a view to a place with a link to the station. Empty if the view has a link, or if there
  /// is no path.
  std::vector<Vector3d> tail(std::size_t view);
  /// Time that the camera takes to turn from one view's direction to the other's [s].
  double turn_s(std::size_t from, std::size_t to) const;

  /// Whether a UAV of a kind has a link to the station at a place: line of sight between antennas, and range.
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
  double picture_s_;  ///< time at rest at each view
  std::vector<Vector3d> places_;
  std::vector<std::size_t> kinds_;  ///< by place
  std::vector<double> takeoff_s_;   ///< by UAV
  std::vector<Ways> ways_;          ///< by kind
  std::vector<std::vector<std::uint8_t>> linked_nodes_;
  std::vector<std::optional<std::vector<std::size_t>>> anchors_;  ///< by place
  std::unordered_map<std::uint64_t, double> flights_;             ///< by pair of places; never iterated
  std::vector<double> tails_;                                     ///< by view; negative: not yet computed
};

}  // namespace skein::sim
