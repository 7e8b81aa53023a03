// Parameters of the planner flock (flock.cpp): --planner flock:near_ratio=0.5.
// Units: SI unless the name says otherwise. d* is the distance at which the camera just has the desired resolution.
#pragma once

#include "core/config/config_reader.hpp"
#include "uav_agent/flight_core/flight_config.hpp"

namespace skein::agent {

/// docs/flock.md has scores without glances, claims, prove_gain and other parts of the method.
struct FlockConfig {
  double voxel_m = 0.0;      ///< edge of a cube of the map; 0: 0.2 d*, limited to 1 to 2 m
  int max_voxels = 250'000;  ///< the cubes grow until the site has no more; chosen: bounds the CPU time
  double density = 0.125;    ///< interest points expected per square metre of surface, before any was seen; chosen
  /// Distances of views, in units of d*: wide, for more in a coarser picture; far; near. Chosen; measured without a
  /// choice between them: docs/flock.md.
  double wide_ratio = 1.5, far_ratio = 0.92, near_ratio = 0.55;
  /// A surface seen with the quality looked_q shows all its interest points; a point that was photographed with good_q
  /// is left out. Chosen; measured with lower ones: docs/flock.md.
  double looked_q = 0.4, good_q = 0.9;
  /// Speed between views that are near each other. Chosen; measured with 2.5 and 5, too (decision 36).
  double inspect_mps = 4.0;
  int max_views = 160;      ///< most views evaluated in one decision; chosen: bounds the CPU time
  int depth = 4;            ///< number of views planned ahead; chosen; measured with 1, too: docs/flock.md
  double glance_s = 0.45;   ///< time for which the camera follows a place on the way to a view; 0: never; chosen
  double replan_s = 1.5;    ///< time between two decisions; chosen; decision 36 tries one at each view, too
  double share_s = 0.5;     ///< time between two messages; chosen
  double claim_s = 4.0;     ///< age at which another UAV's claim of a view expires; 0: claims do not count; chosen
  double prove_gain = 0.3;  ///< share that an explorer adds to the gain of a view from space not proved free; chosen
  double survey_m = 30.0;   ///< a LiDAR finds all structure within this distance; chosen
  FlightConfig flight = {};

  void describe(auto& r) {
    r.field("voxel_m", voxel_m, within(0.0, 10.0));
    r.field("max_voxels", max_voxels, within(1000, 2'000'000));
    r.field("density", density, within(0.001, 100.0));
    r.field("wide_ratio", wide_ratio, within(0.2, 3.0));
    r.field("far_ratio", far_ratio, within(0.2, 1.5));
    r.field("near_ratio", near_ratio, within(0.1, 1.5));
    r.field("looked_q", looked_q, within(0.05, 1.0));
    r.field("good_q", good_q, within(0.1, 1.0));
    r.field("inspect_mps", inspect_mps, within(0.2, 20.0));
    r.field("max_views", max_views, within(1, 5000));
    r.field("depth", depth, within(1, 20));
    r.field("glance_s", glance_s, within(0.0, 5.0));
    r.field("replan_s", replan_s, within(0.1, 30.0));
    r.field("share_s", share_s, within(0.05, 10.0));
    r.field("claim_s", claim_s, within(0.0, 60.0));
    r.field("prove_gain", prove_gain, within(0.0, 10.0));
    r.field("survey_m", survey_m, within(5.0, 100.0));
    r.check(voxel_m == 0.0 || voxel_m >= 0.5, "voxel_m", "must be 0 (by the camera) or at least 0.5");
    r.check(near_ratio <= far_ratio, "near_ratio", "must not be more than far_ratio");
    r.check(far_ratio <= wide_ratio, "far_ratio", "must not be more than wide_ratio");
    flight.describe(r);
  }
};

}  // namespace skein::agent
