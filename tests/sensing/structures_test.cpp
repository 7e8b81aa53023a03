// Random structure of all kinds around a flying UAV: what the map says about the places where structure is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "core/vehicle/lidar_geometry.hpp"
#include "sim_server/sensors/lidar.hpp"
#include "tests/sensing/sensed_space.hpp"
#include "tests/support/test_scenes.hpp"

namespace skein::sensing {
namespace {

/// Random walls with slots, slabs, beams and wires, none within 3 m of the route.
struct DrawnScene {
  TriangleMesh mesh;
  std::vector<Vector3d> surface_W;  ///< random points on its surface, uniform in each part

  DrawnScene(std::uint64_t key, const Flight& flight) {
    RandomStream random(key, "structures", 0);
    const auto clear_m = [&](const Vector3d& p_W) {
      double nearest = 1e9;
      for (double t = 0.0; t < flight.duration_s; t += 0.5) {
        nearest = std::min(nearest, (flight.X_WB(t).translation() - p_W).norm());
      }
      return nearest;
    };
    while (parts_ < 40) {
      const Vector3d centre = flight.X_WB(random.uniform(0.0, flight.duration_s)).translation() +
                              random.uniform(3.5, 28.0) * sim::test::random_unit(random);
      const double kind = random.uniform();
      const Vector3d size = kind < 0.3   ? Vector3d(random.uniform(2.0, 8.0), 0.2, random.uniform(2.0, 8.0))
                            : kind < 0.5 ? sim::test::random_in_box(random, Vector3d::Constant(0.5), {3.0, 3.0, 3.0})
                                         : Vector3d(random.uniform(2.0, 12.0), 0.05, kind < 0.75 ? 0.05 : 0.3);
      const Matrix3d R_WO =
          sim::test::rotation(random.uniform(-3.0, 3.0), random.uniform(-1.5, 1.5), random.uniform(-3.0, 3.0));
      std::vector<Vector3d> places;
      double clear = 1e9;
      for (int i = 0; i < 100; ++i) {
        Vector3d p_O = sim::test::random_in_box(random, -0.5 * size, 0.5 * size);
        const int axis = i % 3;
        p_O[axis] = (i % 2 == 0 ? 0.5 : -0.5) * size[axis];
        places.push_back(centre + R_WO * p_O);
        clear = std::min(clear, clear_m(places.back()));
      }
      if (clear < 3.0) continue;
      sim::test::add_box(mesh, centre, size, R_WO);
      surface_W.insert(surface_W.end(), places.begin(), places.end());
      ++parts_;
    }
  }

 private:
  int parts_ = 0;
};

agent::WorldMapper flown(const DrawnScene& scene, const Flight& flight, const agent::WorldMapper::Config& config) {
  const LidarConfig lidar_config;
  const sim::RayScene world(scene.mesh, {sim::body_shape(VehicleConfig{})});
  sim::Lidar lidar(lidar_config, UavIndex{0}, 0);
  agent::WorldMapper mapper(lidar_config, config);
  agent::BeamScan beams{.columns = lidar_config.columns};
  for (Tick tick = 0; seconds(tick) < flight.duration_s; tick += lidar_period(lidar_config)) {
    const Isometry3d X_WB = flight.X_WB(seconds(tick));
    const sim::LidarScan scan = lidar.scan(tick, X_WB, world);
    beams.beams.clear();
    for (const double range : lidar.ranges()) {
      const bool returned = range >= lidar_config.range_min_m && range <= lidar_config.range_max_m;
      beams.beams.push_back(returned ? agent::BeamScan::Beam{agent::BeamState::range, static_cast<float>(range)}
                                     : agent::BeamScan::Beam{agent::BeamState::none, 0.0F});
    }
    beams.tick = tick;
    beams.fired = {{.first_column = 0, .tick = tick, .X_WL = scan.X_WL}};
    mapper.insert(beams);
  }
  return mapper;
}

class Structures : public testing::TestWithParam<std::size_t> {};

TEST_P(Structures, AreNeverInTubesThatTheMapCallsFree) {
  const Flight flight = flights()[GetParam()];
  std::size_t places = 0, free_places = 0;
  for (std::uint64_t key = 1; key <= 4; ++key) {
    const DrawnScene scene(100 * GetParam() + key, flight);
    const agent::WorldMapper mapper = flown(scene, flight, {});
    for (const Vector3d& p_W : scene.surface_W) {
      ++places;
      free_places += mapper.map().at(p_W) == agent::Space::free;
      EXPECT_FALSE(mapper.map().tube_free(p_W, p_W, kTubeM)) << "scene " << key << ": " << p_W.transpose();
    }
  }
  std::cout << flight.name << ": " << free_places << " of " << places << " places in cubes that are free\n";
}

INSTANTIATE_TEST_SUITE_P(Flights, Structures, testing::Range<std::size_t>(0, flights().size()),
                         [](const auto& param) { return flights()[param.param].name; });

}  // namespace
}  // namespace skein::sensing
