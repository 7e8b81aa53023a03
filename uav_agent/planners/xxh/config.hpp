// Parameters of the XXH planner (xxh.cpp) and of its program at the ground station: --planner xxh:voxel_m=3,rim_m=5.
// Where the sources give a number, it is the default; the table in docs/strategies.md tells which those are.
// Units: SI unless the name says otherwise.
#pragma once

#include <array>
#include <optional>

#include "core/config/config_reader.hpp"
#include "uav_agent/flight_core/flight_config.hpp"
#include "uav_agent/planners/preset.hpp"

namespace skein::agent {

/// In which order the cells of a layer are visited.
enum class XxhOrder {
  spiral,   ///< once around the region, as the explorer flies; the paper
  nearest,  ///< the nearest one first; the public code
};

constexpr std::array<EnumName<XxhOrder>, 2> enum_names(XxhOrder) {
  return {{{"spiral", XxhOrder::spiral}, {"nearest", XxhOrder::nearest}}};
}

/// At which end of its longest edge an upright region is begun.
enum class XxhBegin {
  base,  ///< at its foot, unless no place there is proved to be free: then at its top; the paper
  path,  ///< where the path along all boxes enters it; the public code
};

constexpr std::array<EnumName<XxhBegin>, 2> enum_names(XxhBegin) {
  return {{{"base", XxhBegin::base}, {"path", XxhBegin::path}}};
}

/// Where a team waits beside its region's entry.
enum class XxhWaitAt {
  sight,  ///< at the height from which most of the explorer's way is in sight; the paper
  entry,  ///< as low as it can; the public code
};

constexpr std::array<EnumName<XxhWaitAt>, 2> enum_names(XxhWaitAt) {
  return {{{"sight", XxhWaitAt::sight}, {"entry", XxhWaitAt::entry}}};
}

/// Parameters without a value of their own have one by `faithful`, told behind them: resolved() fills them in.
struct XxhConfig {
  // The assignment at the ground station.
  double freeze_s = 10.0;  ///< without a new reporter, after which the list of UAVs is closed
  std::optional<bool> reported_only =
      {};                           ///< false, true: it stays open for so long, and who did not report is left out
  double assign_every_s = 0.5;      ///< between two publications, as long as somebody lacks the assignment
  double assignment_wait_s = 15.0;  ///< after which a UAV makes the assignment itself
  double split_tolerance = 0.05;    ///< of the whole volume: how far a team's share may be off before a box is cut
  std::optional<int> rounds = {};   ///< 8, 1: through all regions, since early ones may have found no way

  // The voxel map of a region.
  double voxel_m = 2.5, margin_m = 6.0;  ///< edge of a cell; around the region

  // Exploring.
  double rim_m = 4.0;                     ///< from the box to the spiral around it
  int spiral_step = 6;                    ///< layers between two turns of it
  std::optional<XxhBegin> begin = {};     ///< base, path
  std::optional<bool> first_turn = {};    ///< false, true: of each section the first turn of the spiral alone
  std::optional<double> retry_s = {};     ///< 30, 0: to come to some place of a section
  std::optional<double> time_share = {};  ///< 0.4, 0: of the time left, for all sections together; 0: no limit
  double explore_mps = 4.0;
  std::optional<XxhWaitAt> wait_at = {};  ///< sight, entry

  // Inspecting.
  std::optional<int> layer_step = {};       ///< 1, 3: every so many layers one is inspected
  std::optional<XxhOrder> order = {};       ///< spiral, nearest
  double standoff_ratio = 0.6;              ///< distance to the surface, in units of d*, if clearance and cell allow it
  double aim_rad = 0.3;                     ///< a target is reached when the camera is this near to its direction
  double settle_mps = 0.4;                  ///< and the UAV slower than this
  double dwell_s = 0.3;                     ///< pictures of a target once it is reached
  double cell_s = 3.0;                      ///< at one cell, at most
  std::optional<double> leader_share = {};  ///< 0.5, 1: of the layers, in units of each follower's: it begins last

  // The team.
  double share_s = 0.5;                     ///< between two messages
  std::optional<double> claim_s = {};       ///< 3, never: age at which a shared trajectory no longer counts
  std::optional<bool> all_give_way = {};    ///< false, true: to what is announced, also by those who come later
  std::optional<double> silence_s = {};     ///< 45, never: nothing heard of somebody for so long: it is not waited for
  std::optional<double> gather_s = {};      ///< 60, never: the leader waits for the last ones of its team
  std::optional<double> hand_over_s = {};   ///< 25, never: it looks for those who have not heard their order
  std::optional<double> look_again_s = {};  ///< 10, never: between two times that who waits goes over its section again

  bool faithful = false;  ///< as the public code, with its known defects
  FlightConfig flight = {};

  XxhConfig resolved() const;

  template <class R>
  void describe(R& r) {
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
    flight.describe(r);
  }
};

inline XxhConfig XxhConfig::resolved() const {
  XxhConfig all = *this;
  fill(all.reported_only, faithful, false, true);
  fill(all.rounds, faithful, 8, 1);
  fill(all.begin, faithful, XxhBegin::base, XxhBegin::path);
  fill(all.first_turn, faithful, false, true);
  fill(all.retry_s, faithful, 30.0, 0.0);
  fill(all.time_share, faithful, 0.4, 0.0);
  fill(all.wait_at, faithful, XxhWaitAt::sight, XxhWaitAt::entry);
  fill(all.layer_step, faithful, 1, 3);
  fill(all.order, faithful, XxhOrder::spiral, XxhOrder::nearest);
  fill(all.leader_share, faithful, 0.5, 1.0);
  fill(all.claim_s, faithful, 3.0, kNeverS);
  fill(all.all_give_way, faithful, false, true);
  fill(all.silence_s, faithful, 45.0, kNeverS);
  fill(all.gather_s, faithful, 60.0, kNeverS);
  fill(all.hand_over_s, faithful, 25.0, kNeverS);
  fill(all.look_again_s, faithful, 10.0, kNeverS);
  return all;
}

}  // namespace skein::agent
