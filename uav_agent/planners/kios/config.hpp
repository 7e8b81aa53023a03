// Parameters of the KIOS planner (kios.cpp): --planner kios:voxel_m=4,lanes=3. The sources give no values: all defaults
// are our choice.
// Units: SI unless the name says otherwise.
#pragma once

#include "core/config/config_reader.hpp"
#include "uav_agent/flight_core/flight_config.hpp"
#include "uav_agent/planners/preset.hpp"

namespace skein::agent {

/// The comment of an optional parameter gives two defaults: for faithful=false, then for faithful=true. resolved() sets
/// them.
struct KiosConfig {
  static constexpr int kMostReserve = 7;  ///< limit of `reserve`; chosen: a message names all claimed cubes

  double voxel_m = 0.0;  ///< edge of a cube; 0: 0.9 d*, limited to 2.5 to 6 m
  int lanes = 1;         ///< of the mapping stage, for the whole fleet; at least one per explorer
  int min_hits = 4;      ///< mapped cells (0.5 m) that make a cube occupied; chosen
  double map_mps = 3.0;  ///< along the lanes; chosen
  /// Greatest distance to the surface, in units of d*. Chosen; 0.7 was measured, too: better in some scenes, worse in
  /// others (docs/strategies.md).
  double standoff_ratio = 0.92;
  double nearest_ratio = 0.6;  ///< least distance to the surface where there is room, in units of d*; chosen
  double settle_mps = 0.3;     ///< a UAV slower than this is steady (chosen), ...
  double aim_deg = 5.0;        ///< ... a camera this near to its direction is aimed (chosen), ...
  double dwell_s = 0.25;       ///< ... and the UAV stays steady and aimed for this time: two pictures; chosen
  double stop_s = 2.0;         ///< assumed duration of a stop in the planned tours; chosen
  int max_tasks = 150;         ///< most waypoints that are assigned at once; chosen
  int effort = 60'000;         ///< most moves that the tour search evaluates; chosen
  int reserve = 2;             ///< cubes ahead that a UAV claims besides the one it is in; chosen
  double share_s = 0.5;        ///< time between two messages; chosen
  double claim_s = 3.0;        ///< age at which a claim expires; chosen
  /// 45, never: longest time that a photographer waits for the explorers' map, from when it could work.
  std::optional<double> wait_s = {};
  std::optional<double> silence_s = {};  ///< 45, never: the same since it last saw an explorer fly
  std::optional<bool> maps_anew = {};    ///< false, true: a restarted explorer reports `mapping` for all its lanes
  bool faithful = false;                 ///< photographers wait for an explorer's report for ever
  FlightConfig flight = {};

  KiosConfig resolved() const;

  void describe(auto& r) {
    r.field("voxel_m", voxel_m, within(0.0, 20.0));
    r.field("lanes", lanes, within(1, 16));
    r.field("min_hits", min_hits, within(1, 100));
    r.field("map_mps", map_mps, within(0.5, 20.0));
    r.field("standoff_ratio", standoff_ratio, within(0.2, 1.5));
    r.field("nearest_ratio", nearest_ratio, within(0.0, 1.5));
    r.field("settle_mps", settle_mps, within(0.01, 5.0));
    r.field("aim_deg", aim_deg, within(0.1, 90.0));
    r.field("dwell_s", dwell_s, within(0.0, 10.0));
    r.field("stop_s", stop_s, within(0.0, 60.0));
    r.field("max_tasks", max_tasks, within(1, 2000));
    r.field("effort", effort, within(0, 1e7));
    r.field("reserve", reserve, within(0, kMostReserve));
    r.field("share_s", share_s, within(0.05, 10.0));
    r.field("claim_s", claim_s, within(0.1, 60.0));
    r.field("wait_s", wait_s, within(0.0, kNeverS));
    r.field("silence_s", silence_s, within(0.0, kNeverS));
    r.field("maps_anew", maps_anew);
    r.field("faithful", faithful);
    flight.describe_by_time(r);
    r.check(voxel_m == 0.0 || voxel_m >= 1.0, "voxel_m", "must be 0 (by the camera) or at least 1");
  }
};

inline KiosConfig KiosConfig::resolved() const {
  KiosConfig all = *this;
  // Chosen: without limits, photographers wait for most of the mission where one explorer maps a large site.
  constexpr double kWaitS = 45.0;
  fill(all.wait_s, faithful, kWaitS, kNeverS);
  fill(all.silence_s, faithful, kWaitS, kNeverS);
  fill(all.maps_anew, faithful, false, true);
  return all;
}

}  // namespace skein::agent
