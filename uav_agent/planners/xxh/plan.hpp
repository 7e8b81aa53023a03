// XXH's task assignment: the teams, and the boxes that each team inspects, in order. The ground station computes it
// from the UAVs' reports; a UAV that does not receive it computes it in the same way from what it knows.
// Frames: W world.   Units: metres.   Pure and deterministic.
// Source: paper, "Task Assignment" of Team XXH: teams by proximity to the explorers, best-first path along the longest
// dimension of all boxes, shares of the volume in proportion to team size, boxes cut along their longest side.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/types.hpp"
#include "uav_agent/api/agent_config.hpp"
#include "uav_agent/api/payload.hpp"

namespace skein::agent {

/// Where a UAV stands before takeoff.
struct XxhStart {
  std::size_t uav = 0;  ///< index in the fleet
  Role role = Role::explorer;
  Vector3d p_WB = Vector3d::Zero();
};

/// A box, or a slice of one between two planes across its longest edge, and the end at which a team enters it.
struct XxhRegion {
  static constexpr int kWhole = 1000;  ///< parts that the longest edge is counted in; chosen

  std::size_t box = 0;
  int from = 0, to = kWhole;  ///< along the longest edge, in thousandths from its low end
  bool from_high_end = false;

  bool operator==(const XxhRegion&) const = default;
  int share() const { return to - from; }
};

/// Axis of the longest edge; the first one of equal edges.
int longest_axis(const OrientedBox& box);
/// The end of the longest edge that is below the other one; nullopt if the edge is less than 45 degrees steep.
enum class BoxEnd { low, high };
std::optional<BoxEnd> foot_end(const OrientedBox& box);
double volume_of(const OrientedBox& box);  ///< [m^3]
/// The region as a box with the same axes.
OrientedBox region_box(const XxhRegion& region, const OrientedBox& box);
/// Where a team leaves the region: the middle of the face opposite to the one at which it enters.
Vector3d far_end(const XxhRegion& region, const OrientedBox& box);
struct XxhTeam {
  std::vector<std::size_t> members;  ///< its explorer first, if it has one; the others in fleet order
  std::vector<XxhRegion> regions;    ///< in the order of visit

  bool operator==(const XxhTeam&) const = default;
};

struct XxhPlan {
  std::vector<XxhTeam> teams;

  bool operator==(const XxhPlan&) const = default;
  /// The team of a UAV; nullptr if it has none.
  const XxhTeam* team_of(std::size_t uav) const;
};

/// Computes the assignment.
/// @param starts  of all UAVs that take part; empty: no teams.
/// @param tolerance  how far a team's share may be off before a box is cut, in shares of all volume; at most 0.05.
/// @returns one team for each explorer, the larger ones first; one team if there is no explorer.
XxhPlan assign(std::vector<XxhStart> starts, const std::vector<OrientedBox>& boxes, double tolerance);

/// The reported start, or the nominal start if it is within a metre of it: so a UAV that computes the assignment itself
/// gets the same result as the station.
Vector3d settled_start(const Vector3d& reported_W, const Vector3d& nominal_W);

void write_plan(const XxhPlan& plan, PayloadWriter& writer);
/// @returns nullopt if the message is damaged, or names a UAV or a box that does not exist.
std::optional<XxhPlan> read_plan(PayloadReader& reader, std::size_t uavs, std::size_t boxes);

}  // namespace skein::agent
