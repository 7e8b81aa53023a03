// What every UAV works out alike from the same list of starts: teams, their regions, and the sections of a region.
// Pure, no ROS.   Frame: W world (ENU).   Units: m.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace baseline {

using Vector = Eigen::Vector3d;

/// A box or a slice of one. Layers lie across its longest edge; the team enters at `entry`.
struct Region {
  Vector entry = Vector::Zero();            ///< middle of the face at which layer 0 lies
  Vector along = Vector::UnitZ();           ///< its longest edge, away from there
  Vector side[2];                           ///< its other edges; unit vectors
  double length = 0.0, half[2] = {0., 0.};  ///< along, and to either side

  double volume() const { return length * 4.0 * half[0] * half[1]; }
  int layers() const;
  /// The layer that a place belongs to, -1 if it is more than 6 m outside.
  int layer_of(const Vector& p_W) const;
  /// How far outside of the region a place is.
  double distance(const Vector& p_W) const;
  /// The same beside it; negative within.
  double distance_beside(const Vector& p_W) const;
  /// The first layers of the sections into which a team of that size divides it, and layers() behind them.
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

/// A team for each explorer, photographers to the nearest. One path visits all boxes, each from end to end and always
/// the nearest end next; each team gets a stretch of it in proportion to its size. A box is cut where a share ends
/// within it by more than 5 % of all volume. Without explorers the first of all leads.
std::vector<Team> make_teams(const std::map<std::string, Start>& fleet, std::vector<Region> boxes);

}  // namespace baseline
