// XXH's task assignment: who flies with whom, and which team inspects which boxes in which order. The ground station
// computes it from what the UAVs report; a UAV that never hears of it computes the same from what it knows.
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

/// Where somebody stands before it takes off.
struct XxhStart {
  std::size_t uav = 0;  ///< index in the fleet
  Role role = Role::explorer;
  Vector3d p_WB = Vector3d::Zero();
};

/// A box, or a slice of one between two planes across its longest edge, and the end at which one enters it.
struct XxhRegion {
  static constexpr int kWhole = 1000;

  std::size_t box = 0;
  int from = 0, to = kWhole;  ///< of the longest edge, in thousandths from its lower end
  bool from_high_end = false;

  bool operator==(const XxhRegion&) const = default;
  int share() const { return to - from; }
};

/// Index of the longest edge; of equal ones the first.
int longest_axis(const OrientedBox& box);
/// The end of the longest edge that is below the other one; nothing if that edge lies more than it stands.
enum class BoxEnd { low, high };
std::optional<BoxEnd> foot_end(const OrientedBox& box);
double volume_of(const OrientedBox& box);
/// The region as a box with the same axes.
OrientedBox region_box(const XxhRegion& region, const OrientedBox& box);
/// Where one leaves it: the middle of the face opposite to the one at which one enters.
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

/// @param starts  of those who take part; empty: nobody gets anything.
/// @param tolerance  of the whole volume: how far a team's share may be off before a box is cut; at most 0.05.
/// @returns one team for each explorer, the larger ones first; one team if there is no explorer.
XxhPlan assign(std::vector<XxhStart> starts, const std::vector<OrientedBox>& boxes, double tolerance);

/// A reported start, or the nominal place if it is within a metre of that: then whoever computes for itself gets what
/// the station gets.
Vector3d settled_start(const Vector3d& reported_W, const Vector3d& nominal_W);

void write_plan(const XxhPlan& plan, PayloadWriter& writer);
/// @returns nullopt for what is damaged or names a UAV or a box that there is not.
std::optional<XxhPlan> read_plan(PayloadReader& reader, std::size_t uavs, std::size_t boxes);

}  // namespace skein::agent
