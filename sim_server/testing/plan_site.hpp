// For the tests of the plan: a block with points on its sides and its top, a wall beside it, and a small fleet.
// Frame W.   Units: SI.
#pragma once

#include <string>

#include "core/scenario/scenario_reader.hpp"
#include "sim_server/plan/plan.hpp"
#include "tests/support/places.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sim::test {

struct PlanSite {
  Scenario scenario;
  Scene scene;
  PlanConfig config;

  /// @param uavs  the first is an explorer, the others are photographers.
  explicit PlanSite(std::size_t uavs = 2, double duration_s = 90.0) {
    scenario.name = "site";
    scenario.duration_s = duration_s;
    scenario.station_position = {-2.0, 8.0, 0.3};
    for (std::size_t i = 0; i < uavs; ++i) {
      UavConfig uav;
      uav.name = "uav" + std::to_string(i);
      uav.vehicle = load_vehicle(i == 0 ? "explorer" : "photographer", source_path("config"));
      uav.start = {-4.0, -6.0 + 4.0 * static_cast<double>(i)};
      scenario.fleet.push_back(uav);
    }
    add_block({16.0, 0.0, 7.0}, {8.0, 12.0, 14.0});
    add_box(scene.mesh, {16.0, 14.0, 6.0}, {20.0, 0.4, 12.0});
    config.rounds = 6;
    config.most_views = 1500;
    config.most_seeds = 200;
    config.most_nodes = 600;
  }

 private:
  /// Points every two metres on all faces but the bottom.
  void add_block(const Vector3d& centre, const Vector3d& size) {
    add_box(scene.mesh, centre, size);
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {-1.0, 1.0}) {
        if (axis == 2 && side < 0.0) continue;
        add_face(centre, size, axis, side);
      }
    }
  }
  void add_face(const Vector3d& centre, const Vector3d& size, int axis, double side) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const Vector3d n_W = side * Vector3d::Unit(axis);
    for (double a = 1.0; a < size[u]; a += 2.0) {
      for (double b = 1.0; b < size[v]; b += 2.0) {
        Vector3d p_W = centre + 0.5 * size[axis] * n_W;
        p_W[u] += a - 0.5 * size[u];
        p_W[v] += b - 0.5 * size[v];
        scene.points.push_back({p_W.cast<float>(), n_W.cast<float>()});
      }
    }
  }
};

}  // namespace skein::sim::test
