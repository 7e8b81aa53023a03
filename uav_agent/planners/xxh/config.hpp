// Parameters of the XXH planner (xxh.cpp) and of its program at the ground station: --planner xxh:voxel_m=3,rim_m=5.
// The public code is that of XXH's team. The table in docs/strategies.md gives the source of each default: paper,
// public code or our choice.
// Units: SI unless the name says otherwise.
#pragma once

#include <array>
#include <optional>

#include "core/config/config_reader.hpp"
#include "uav_agent/flight_core/flight_config.hpp"
#include "uav_agent/planners/preset.hpp"

namespace skein::agent {

/// Order in which the cells of a layer are visited.
enum class XxhOrder {
  spiral,   ///< once around the region, in the explorer's direction; the paper
  nearest,  ///< the nearest one first; the public code
};

constexpr std::array<EnumName<XxhOrder>, 2> enum_names(XxhOrder) {
  return {{{"spiral", XxhOrder::spiral}, {"nearest", XxhOrder::nearest}}};
}

/// End of the longest edge at which a team begins an upright region.
enum class XxhBegin {
  base,  ///< at its foot; at its top if no place at the foot is proved free; the paper
  path,  ///< where the path along all boxes enters it; the public code
};

constexpr std::array<EnumName<XxhBegin>, 2> enum_names(XxhBegin) {
  return {{{"base", XxhBegin::base}, {"path", XxhBegin::path}}};
}

/// Where a UAV waits beside its region's entry.
enum class XxhWaitAt {
  sight,  ///< at the height from which it sees most of the explorer's path; the paper
  entry,  ///< as low as it can; the public code
};

constexpr std::array<EnumName<XxhWaitAt>, 2> enum_names(XxhWaitAt) {
  return {{{"sight", XxhWaitAt::sight}, {"entry", XxhWaitAt::entry}}};
}

/// The comment of an optional parameter gives two defaults: for faithful=false, then for faithful=true. resolved() sets
/// them.
struct XxhConfig {
  // The assignment at the ground station.
  /// Time without a new report after which the list of UAVs is closed. Chosen as in the public code.
  double freeze_s = 10.0;
  /// false, true: the station waits freeze_s even if all UAVs have reported, and leaves out UAVs that have not.
  std::optional<bool> reported_only = {};
  /// Time between two publications, as long as a UAV lacks the assignment. Chosen; public code: 0.1.
  double assign_every_s = 0.5;
  double assignment_wait_s = 15.0;  ///< time after which a UAV computes the assignment itself; chosen
  /// Allowed error of a team's share, in shares of all volume; else a box is cut. Chosen as in the public code.
  double split_tolerance = 0.05;
  std::optional<int> rounds = {};  ///< 8, 1: rounds through all regions: an early one may find places unreachable

  // The voxel map of a region.
  double voxel_m = 2.5, margin_m = 6.0;  ///< edge of a cell; margin around the region; chosen as in the public code

  // Exploring.
  double rim_m = 4.0;                     ///< distance from the box to the spiral around it; chosen
  int spiral_step = 6;                    ///< layers between two turns of the spiral; chosen
  std::optional<XxhBegin> begin = {};     ///< base, path
  std::optional<bool> first_turn = {};    ///< false, true: only the first turn of the spiral in each section
  std::optional<double> retry_s = {};     ///< 30, 0: how long a section is tried again of which no place was reached
  std::optional<double> time_share = {};  ///< 0.4, 0: share of the remaining time for all sections; 0: no limit
  double explore_mps = 4.0;               ///< greatest speed along the spiral; chosen; public code: 2
  std::optional<XxhWaitAt> wait_at = {};  ///< sight, entry

  // Inspecting.
  std::optional<int> layer_step = {};  ///< 1, 3: of this many successive layers, one is inspected
  std::optional<XxhOrder> order = {};  ///< spiral, nearest
  double standoff_ratio = 0.6;         ///< distance to the surface, in units of d*, where there is room; chosen
  /// A target is reached if the camera is this near to its direction (chosen as in the public code) ...
  double aim_rad = 0.3;
  double settle_mps = 0.4;                  ///< ... and the UAV slower than this; chosen
  double dwell_s = 0.3;                     ///< time for the pictures of a target once it is reached; chosen
  double cell_s = 3.0;                      ///< longest time at one cell; chosen as in the public code
  std::optional<double> leader_share = {};  ///< 0.5, 1: the leader's layers per follower's; it begins last

  // The team.
  double share_s = 0.5;                     ///< time between two messages; chosen
  std::optional<double> claim_s = {};       ///< 3, never: age at which an announced trajectory expires
  std::optional<bool> all_give_way = {};    ///< false, true: UAVs with priority avoid announced trajectories, too
  std::optional<double> silence_s = {};     ///< 45, never: silence of a UAV after which others do not wait for it
  std::optional<double> gather_s = {};      ///< 60, never: longest wait of the leader for the last of its team
  std::optional<double> hand_over_s = {};   ///< 25, never: the same for members that have not received their order
  std::optional<double> look_again_s = {};  ///< 10, never: pause of a waiting UAV between passes over its section

  bool faithful = false;  ///< like the public code, with its known defects
  FlightConfig flight = {};

  XxhConfig resolved() const;

  void describe(auto& r) {
    r.field("freeze_s", freeze_s, within(0.0, 55.0));
    r.field("reported_only", reported_only);
    r.field("assign_every_s", assign_every_s, within(0.05, 10.0));
    r.field("assignment_wait_s", assignment_wait_s, within(0.0, 55.0));
    r.field("split_tolerance", split_tolerance, within(0.0, 0.05));
    r.field("rounds", rounds, within(1, 100));
    r.field("voxel_m", voxel_m, within(1.0, 20.0));
    r.field("margin_m", margin_m, within(1.0, 30.0));
    r.field("rim_m", rim_m, within(2.0, 30.0));
    r.field("spiral_step", spiral_step, within(1, 100));
    r.field("begin", begin);
    r.field("first_turn", first_turn);
    r.field("retry_s", retry_s, within(0.0, kNeverS));
    r.field("time_share", time_share, within(0.0, 1.0));
    r.field("explore_mps", explore_mps, within(0.2, 20.0));
    r.field("wait_at", wait_at);
    r.field("layer_step", layer_step, within(1, 20));
    r.field("order", order);
    r.field("standoff_ratio", standoff_ratio, within(0.0, 1.5));
    r.field("aim_rad", aim_rad, within(0.005, 1.5));
    r.field("settle_mps", settle_mps, within(0.01, 5.0));
    r.field("dwell_s", dwell_s, within(0.0, 10.0));
    r.field("cell_s", cell_s, within(0.1, 60.0));
    r.field("leader_share", leader_share, within(0.1, 1.0));
    r.field("share_s", share_s, within(0.05, 10.0));
    r.field("claim_s", claim_s, within(0.1, kNeverS));
    r.field("all_give_way", all_give_way);
    r.field("silence_s", silence_s, within(1.0, kNeverS));
    r.field("gather_s", gather_s, within(0.0, kNeverS));
    r.field("hand_over_s", hand_over_s, within(0.0, kNeverS));
    r.field("look_again_s", look_again_s, within(1.0, kNeverS));
    r.field("faithful", faithful);
    flight.describe_by_time(r);
  }
};

inline XxhConfig XxhConfig::resolved() const {
  XxhConfig all = *this;
  fill(all.reported_only, faithful, false, true);
  fill(all.rounds, faithful, 8, 1);  // chosen
  fill(all.begin, faithful, XxhBegin::base, XxhBegin::path);
  fill(all.first_turn, faithful, false, true);
  fill(all.retry_s, faithful, 30.0, 0.0);    // chosen
  fill(all.time_share, faithful, 0.4, 0.0);  // chosen
  fill(all.wait_at, faithful, XxhWaitAt::sight, XxhWaitAt::entry);
  fill(all.layer_step, faithful, 1, 3);
  fill(all.order, faithful, XxhOrder::spiral, XxhOrder::nearest);
  fill(all.leader_share, faithful, 0.5, 1.0);
  fill(all.claim_s, faithful, 3.0, kNeverS);  // chosen
  fill(all.all_give_way, faithful, false, true);
  fill(all.silence_s, faithful, 45.0, kNeverS);     // chosen
  fill(all.gather_s, faithful, 60.0, kNeverS);      // chosen
  fill(all.hand_over_s, faithful, 25.0, kNeverS);   // chosen
  fill(all.look_again_s, faithful, 10.0, kNeverS);  // chosen
  return all;
}

}  // namespace skein::agent
