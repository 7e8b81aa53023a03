// Parameters of the STAR planner (star.cpp): --planner star:inspect_mps=1.5,voxel_m=2.5. No source gives a
// number for this contest, so all defaults are our choice; comments name papers with the same or a similar number. d*:
// the distance at which the camera just has the desired resolution.
// Units: SI unless the name says otherwise.
#pragma once

#include "core/config/config_reader.hpp"
#include "uav_agent/flight_core/flight_config.hpp"
#include "uav_agent/planners/preset.hpp"
#include "uav_agent/planning/fleet_tours.hpp"

namespace skein::agent {

/// The comment of an optional parameter gives two defaults: for faithful=false, then for faithful=true. resolved() sets
/// them.
struct StarConfig {
  double voxel_m = 0.0;          ///< edge of a cube of the grid; 0: 0.35 d*, limited to 2 to 3 m
  int max_voxels = 120'000;      ///< on larger sites, the cubes grow until there are no more; chosen
  double volume_weight = 0.005;  ///< cost of a box in the teams' tours: metres of path per cubic metre; chosen
  /// What the assignment of boxes minimises: `total`, the sum of all tours, or `longest`, the longest tour of a team.
  FleetTourObjective share = FleetTourObjective::total;
  double explore_mps = 2.5;  ///< chosen as in SOAR; FUEL: 2
  double inspect_mps = 2.0;  ///< chosen as in Star-Searcher
  double replan_s = 1.5;     ///< time between two plans; chosen as in FUEL
  double covered_s = 0.5;    ///< least time between two plans once the target is done; chosen as in FUEL
  double turn_s = 1.5;       ///< cost of a change of direction, per radian; chosen: FUEL's weight
  double round_m = 2.0;      ///< most distance from a corner at which the path cuts it off; chosen
  double horizon_m = 20.0;   ///< length of the path that is planned ahead; chosen
  double margin_m = 6.0;     ///< width of the space around a box that is explored with it; chosen
  double cluster_m = 8.0;    ///< largest extent of a cluster of frontier cubes; chosen; FUEL: 2, in rooms
  int min_cluster = 3;       ///< fewest cubes of a cluster; chosen
  /// Radii of explorers' viewpoints around a cluster. Chosen; SOAR: 8 to 11; FUEL: 1.5 to 2.5, in rooms.
  double ring_inner_m = 5.0, ring_outer_m = 11.0;
  int refine = 5;  ///< how many of the next viewpoints are refined; chosen; FUEL: up to 7
  int looks = 6;   ///< seconds in view and near by, after which an explorer gives up a frontier cube; chosen
  double standoff_ratio = 0.85;  ///< distance of photographers' viewpoints to the surface, in units of d*; chosen
  double seen_ratio = 1.0;       ///< a surface seen from within this (in units of d*; chosen) counts as inspected, ...
  double oblique_deg = 65.0;     ///< ... if its normal is within this angle of the line of sight; chosen
  double patch_m = 0.0;          ///< largest patch of surface with one viewpoint; 0: the picture's height there
  double view_radius_m = 10.0;   ///< radius of a cluster of viewpoints; chosen; Star-Searcher: 3, indoors
  double history_s = 4.0;        ///< cost of beginning with another cluster than in the last plan; chosen
  std::optional<double> mate_s = {};  ///< 8, 0: cost of beginning where another UAV is about to work
  int max_views = 150;                ///< most viewpoints in one plan: the nearest ones; chosen
  int effort = 30'000;                ///< most moves that a tour search evaluates; chosen
  double share_s = 0.5;               ///< time between two messages; chosen; RACER: 0.1
  /// 3, never: time without work, after which a photographer flies to its explorer's box or one of the team's, and an
  /// explorer begins one of its boxes again.
  std::optional<double> follow_s = {};
  std::optional<bool> helps = {};  ///< true, false: a team without a box, or without work, helps others
  /// Explorers aim their cameras at surface that they pass, and inspect like photographers when they have explored
  /// their boxes. An explorer alone in its team always does. Others only explore, with the camera towards frontiers.
  bool explorers_inspect = false;
  bool faithful = false;  ///< follows the sources, and leaves out what they do not mention
  FlightConfig flight = {};

  StarConfig resolved() const;

  void describe(auto& r) {
    r.field("voxel_m", voxel_m, within(0.0, 20.0));
    r.field("max_voxels", max_voxels, within(1000, 2'000'000));
    r.field("volume_weight", volume_weight, within(0.0, 1.0));
    r.field("share", share);
    r.field("explore_mps", explore_mps, within(0.2, 20.0));
    r.field("inspect_mps", inspect_mps, within(0.2, 20.0));
    r.field("replan_s", replan_s, within(0.2, 30.0));
    r.field("covered_s", covered_s, within(0.1, 30.0));
    r.field("turn_s", turn_s, within(0.0, 30.0));
    r.field("round_m", round_m, within(0.0, 10.0));
    r.field("horizon_m", horizon_m, within(2.0, 200.0));
    r.field("margin_m", margin_m, within(0.0, 20.0));
    r.field("cluster_m", cluster_m, within(2.0, 50.0));
    r.field("min_cluster", min_cluster, within(1, 1000));
    r.field("ring_inner_m", ring_inner_m, within(1.0, 50.0));
    r.field("ring_outer_m", ring_outer_m, within(1.0, 50.0));
    r.field("refine", refine, within(0, 20));
    r.field("looks", looks, within(1, 200));
    r.field("standoff_ratio", standoff_ratio, within(0.2, 1.5));
    r.field("seen_ratio", seen_ratio, within(0.2, 3.0));
    r.field("oblique_deg", oblique_deg, within(1.0, 89.0));
    r.field("patch_m", patch_m, within(0.0, 50.0));
    r.field("view_radius_m", view_radius_m, within(0.0, 100.0));
    r.field("history_s", history_s, within(0.0, 100.0));
    r.field("mate_s", mate_s, within(0.0, 100.0));
    r.field("max_views", max_views, within(1, 1000));
    r.field("effort", effort, within(0, 1e7));
    r.field("share_s", share_s, within(0.05, 10.0));
    r.field("follow_s", follow_s, within(0.0, kNeverS));
    r.field("helps", helps);
    r.field("explorers_inspect", explorers_inspect);
    r.field("faithful", faithful);
    r.check(voxel_m == 0.0 || voxel_m >= 1.0, "voxel_m", "must be 0 (by the camera) or at least 1");
    r.check(ring_inner_m <= ring_outer_m, "ring_outer_m", "must not be less than ring_inner_m");
    flight.describe_by_time(r);
  }
};

inline StarConfig StarConfig::resolved() const {
  StarConfig all = *this;
  fill(all.mate_s, faithful, 8.0, 0.0);        // chosen; the sources know no such cost
  fill(all.follow_s, faithful, 3.0, kNeverS);  // chosen; in the sources, UAVs without work hover
  fill(all.helps, faithful, true, false);
  return all;
}

}  // namespace skein::agent
