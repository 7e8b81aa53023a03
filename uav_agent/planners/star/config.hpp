// Parameters of the STAR planner (star.cpp): --planner star:inspect_mps=1.5,voxel_m=2.5. Where no source is named, none
// gives a number, and the default is our choice.
// Units: SI unless the name says otherwise.
#pragma once

#include "core/config/config_reader.hpp"
#include "uav_agent/flight_core/flight_config.hpp"
#include "uav_agent/planners/preset.hpp"
#include "uav_agent/planning/fleet_tours.hpp"

namespace skein::agent {

/// Parameters without a value of their own have one by `faithful`, told behind them: resolved() fills them in.
struct StarConfig {
  double voxel_m = 0.0;          ///< edge of a cube of the map; 0: 0.35 d*, but 2 to 3 m
  int max_voxels = 120'000;      ///< the cubes grow until the site has no more
  double volume_weight = 0.005;  ///< of a box in the teams' tours: metres of way for a cubic metre
  /// What the teams' tours are to have short: `total`, the way of all, or `longest`, that of the team with most to do.
  FleetTourObjective share = FleetTourObjective::total;
  double explore_mps = 2.5, inspect_mps = 2.0;     ///< after FUEL's and Star-Searcher's 2 m/s, and SOAR's 2.5
  double replan_s = 1.5;                           ///< FUEL
  double covered_s = 0.5;                          ///< and no sooner than this when the target is done; FUEL
  double turn_s = 1.5;                             ///< cost of a change of direction, a radian; FUEL's weight
  double round_m = 2.0;                            ///< how far from a corner a way may cut it off
  double horizon_m = 20.0;                         ///< length of the way that is laid out
  double margin_m = 6.0;                           ///< around a box, that is explored with it
  double cluster_m = 8.0;                          ///< largest cluster of frontier cubes
  int min_cluster = 3;                             ///< cubes
  double ring_inner_m = 5.0, ring_outer_m = 11.0;  ///< of the explorer's viewpoints; SOAR's ring is 8 to 11
  int refine = 5;                                  ///< next viewpoints that are refined; FUEL: up to 7
  int looks = 6;                      ///< seconds in view after which a frontier that stays one is given up
  double standoff_ratio = 0.85;       ///< distance of the photographers to the surface, in units of d*
  double seen_ratio = 1.0;            ///< a surface seen from so near (in units of d*) counts as inspected, ...
  double oblique_deg = 65.0;          ///< ... if its normal is no more than this off the line of sight
  double patch_m = 0.0;               ///< largest piece of surface with one viewpoint; 0: as high as the picture there
  double view_radius_m = 10.0;        ///< of a cluster of viewpoints; Star-Searcher: 3 in rooms
  double history_s = 4.0;             ///< cost of beginning with another cluster than last time
  std::optional<double> mate_s = {};  ///< 8, 0: cost of beginning where another UAV is about to work
  int max_views = 150;                ///< viewpoints in one plan, the nearest ones
  int effort = 30'000;                ///< moves evaluated for a tour
  double share_s = 0.5;               ///< between two messages
  /// 3, never: with nothing to do, before a photographer goes where its explorer is, and an explorer around its boxes.
  std::optional<double> follow_s = {};
  std::optional<bool> helps = {};  ///< true, false: a team that has no box, or nothing left to do, works on others'
  /// Explorers aim at surface that they pass, and inspect as photographers do when they have explored. Else they
  /// explore, and their cameras see what is ahead.
  bool explorers_inspect = false;
  bool faithful = false;  ///< what the sources tell or leave out
  FlightConfig flight = {};

  StarConfig resolved() const;

  template <class R>
  void describe(R& r) {
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
    flight.describe(r);
  }
};

inline StarConfig StarConfig::resolved() const {
  StarConfig all = *this;
  fill(all.mate_s, faithful, 8.0, 0.0);
  fill(all.follow_s, faithful, 3.0, kNeverS);
  fill(all.helps, faithful, true, false);
  return all;
}

}  // namespace skein::agent
