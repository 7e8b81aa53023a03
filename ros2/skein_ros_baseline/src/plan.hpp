// Computations with the same result on every UAV, from the same list of starts: teams, their regions, and the sections
// of a region.
// Pure, no ROS.   Frame: W world (ENU).   Units: m.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace baseline {

using Vector = Eigen::Vector3d;

/// A box or a slice of one. Layers lie across the box's longest edge; the team enters at `entry`.
struct Region {
  Vector entry = Vector::Zero();            ///< middle of the face at which layer 0 lies
  Vector along = Vector::UnitZ();           ///< the box's longest edge, away from `entry`
  Vector side[2];                           ///< the other edges; unit vectors
  double length = 0.0, half[2] = {0., 0.};  ///< along, and to either side

  double volume() const { return length * 4.0 * half[0] * half[1]; }
  int layers() const;
  /// The layer to which a place belongs; -1 if it is more than 6 m outside.
  int layer_of(const Vector& p_W) const;
  /// How far outside of the region a place is.
  double distance(const Vector& p_W) const;
  /// The same, but only perpendicular to `along`; negative within.
  double distance_beside(const Vector& p_W) const;
  /// A team of that size divides the region into as many sections: the first layer of each, then layers().
  std::vector<int> sections(int team_size) const;
};

struct Start {
  bool explorer = false;
  Vector p_W = Vector::Zero();
};

struct Team {
  std::vector<std::string> members;  ///< the leader first
  std::vector<Region> regions;       ///< in the order of the work
};

/// The box of eight vertices, in any order.
Region box_of(const std::vector<Vector>& vertices_W);

/// One team for each explorer; a photographer joins the nearest. Without explorers, the first UAV leads the only team.
/// One path visits all boxes, each from end to end and always the nearest end next. Each team gets a stretch of it in
/// proportion to its size. A share that ends within a box cuts it if both parts have more than 5 % of all volume.
std::vector<Team> make_teams(const std::map<std::string, Start>& fleet, std::vector<Region> boxes);

}  // namespace baseline
