// Parameters of the XXH planner (xxh.cpp) and of its program at the ground station: --planner xxh:voxel_m=3,rim_m=5.
// Where the sources give a number, it is the default; the table in docs/strategies.md tells which those are.
// Units: SI unless the name says otherwise.
#pragma once

#include "core/config_reader.hpp"
#include "uav_agent/flight_core/flight_config.hpp"

namespace skein::agent {

struct XxhConfig {
  // The assignment at the ground station.
  double freeze_s = 10.0;           ///< without a new reporter, after which the list of UAVs is closed
  double assign_every_s = 0.5;      ///< between two publications, as long as somebody lacks the assignment
  double assignment_wait_s = 15.0;  ///< after which a UAV makes the assignment itself
  double split_tolerance = 0.05;    ///< of the whole volume: a team's share may differ by so much before a box is cut

  // The voxel map of a region.
  double voxel_m = 2.5, margin_m = 6.0;  ///< edge of a cell; around the region

  // Exploring.
  double rim_m = 4.0;   ///< from the box to the spiral around it
  int spiral_step = 6;  ///< layers between two turns of it
  double explore_mps = 4.0;

  // Inspecting.
  int layer_step = 3;           ///< every so many layers one is inspected
  double standoff_ratio = 0.6;  ///< distance to the surface, in units of d*, if clearance and cell allow it
  double aim_rad = 0.3;         ///< a target is reached when the camera is this near to its direction
  double settle_mps = 0.4;      ///< and the UAV slower than this
  double dwell_s = 0.3;         ///< pictures of a target once it is reached
  double cell_s = 3.0;          ///< at one cell, at most
  double leader_share = 0.5;    ///< of the layers, in units of each follower's: the leader begins last

  // The team.
  double share_s = 0.5;     ///< between two messages
  double claim_s = 3.0;     ///< age at which a shared trajectory no longer counts
  double silence_s = 45.0;  ///< nothing heard of somebody for so long: it is not waited for
  double gather_s = 60.0;   ///< the leader waits for the last ones of its team

  bool faithful = false;  ///< with the known defects of the public code: see xxh.cpp
  FlightConfig flight = {};

  template <class R>
  void describe(R& r) {
    r.field("freeze_s", freeze_s, within(0.0, 55.0));
    r.field("assign_every_s", assign_every_s, within(0.05, 10.0));
    r.field("assignment_wait_s", assignment_wait_s, within(0.0, 55.0));
    r.field("split_tolerance", split_tolerance, within(0.0, 0.05));
    r.field("voxel_m", voxel_m, within(1.0, 20.0));
    r.field("margin_m", margin_m, within(1.0, 30.0));
    r.field("rim_m", rim_m, within(2.0, 30.0));
    r.field("spiral_step", spiral_step, within(1, 100));
    r.field("explore_mps", explore_mps, within(0.2, 20.0));
    r.field("layer_step", layer_step, within(1, 20));
    r.field("standoff_ratio", standoff_ratio, within(0.0, 1.5));
    r.field("aim_rad", aim_rad, within(0.005, 1.5));
    r.field("settle_mps", settle_mps, within(0.01, 5.0));
    r.field("dwell_s", dwell_s, within(0.0, 10.0));
    r.field("cell_s", cell_s, within(0.1, 60.0));
    r.field("leader_share", leader_share, within(0.1, 1.0));
    r.field("share_s", share_s, within(0.05, 10.0));
    r.field("claim_s", claim_s, within(0.1, 60.0));
    r.field("silence_s", silence_s, within(1.0, 1e4));
    r.field("gather_s", gather_s, within(0.0, 1e4));
    r.field("faithful", faithful);
    flight.describe(r);
  }
};

}  // namespace skein::agent
