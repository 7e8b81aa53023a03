// Compares the map on board with a reference map that counts each beam individually, in cubes of 0.5 m everywhere.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "core/vehicle/lidar_geometry.hpp"
#include "tests/sensing/sensed_space.hpp"

namespace skein::sensing {
namespace {

/// A UAV hovers for one sweep. At least half of the space in straight tubes of 10 m that start at it is free. The share
/// of their length at which the whole cross-section is free is 0.45 with individual beams, and 0.42 on board.
TEST(OneSweep, ProvesHalfOfTheSpaceWithinTenMetresFree) {
  for (const bool exact : {false, true}) {
    for (const double phase_s : {3.0, 0.5, 5.0}) {  // both directions of the servo
      const SensedSpace space(flights().front(), phase_s, exact ? exact_map() : agent::WorldMapper::Config());
      const Vector3d start_W(0.0, 0.0, kHeightM);
      RandomStream random(5, "ways", 0);
      std::size_t free_steps = 0, steps = 0, free_places = 0, places = 0;
      for (int way = 0; way < 300; ++way) {
        const Vector3d along = drawn_direction(random), across = along.unitOrthogonal();
        for (double from = 0.0; from < 10.0; from += 0.5) {
          ++steps;
          if (space.map().tube_free(start_W + from * along, start_W + (from + 0.5) * along, kTubeM)) ++free_steps;
          for (int place = 0; place < 10; ++place, ++places) {
            const Vector3d off = kTubeM * std::sqrt(random.uniform()) * across;
            const Vector3d turned = Eigen::AngleAxisd(random.uniform(-3.14, 3.14), along) * off;
            if (space.map().at(start_W + (from + 0.25) * along + turned) == agent::Space::free) ++free_places;
          }
        }
      }
      std::cout << (exact ? "each beam" : "on board") << ", phase " << phase_s << " s: " << free_steps << " of "
                << steps << " steps, " << free_places << " of " << places << " places\n";
      EXPECT_GE(10 * free_steps, 4 * steps) << phase_s;
      EXPECT_GE(2 * free_places, places) << phase_s;
    }
  }
}

class FlownMap : public testing::TestWithParam<std::size_t> {};

/// The map on board assigns all beams of a bundle to one window. So at the border of the proved space, cubes may be
/// free in only one of the two maps, but tubes hardly ever. drawn_members_test.cpp tests the criterion for each map.
TEST_P(FlownMap, AgreesWithTheMapOfIndividualBeams) {
  const Flight flight = flights()[GetParam()];
  const SensedSpace flown(flight, 3.0, {}), exact(flight, 3.0, exact_map());
  RandomStream random(GetParam() + 1, "flown_map", 0);
  std::size_t places = 0, flown_free = 0, exact_free = 0, tubes = 0, more = 0;
  while (places < 3000) {
    const auto scan = static_cast<std::size_t>(random.uniform() * static_cast<double>(flown.scans().size()));
    const Vector3d p_W =
        flown.scans()[scan].translation() + 16.0 * std::cbrt(random.uniform()) * drawn_direction(random);
    ++places;
    flown_free += flown.map().at(p_W) == agent::Space::free;
    exact_free += exact.map().at(p_W) == agent::Space::free;
    if (!flown.map().tube_free(p_W, p_W, kTubeM)) continue;
    ++tubes;
    more += !exact.map().tube_free(p_W, p_W, kTubeM);
  }
  std::cout << flight.name << ": " << flown_free << " of " << places << " places free, " << exact_free
            << " with each beam; " << more << " of " << tubes << " tubes are free on board alone\n";
  EXPECT_GE(static_cast<double>(flown_free), 0.95 * static_cast<double>(exact_free));
  EXPECT_LE(static_cast<double>(more), 0.12 * static_cast<double>(tubes));
}

INSTANTIATE_TEST_SUITE_P(Flights, FlownMap, testing::Range<std::size_t>(0, flights().size()),
                         [](const auto& flight) { return flights()[flight.param].name; });

/// The effort is measured by counts, not by time: windows that beams pass, and bytes.
TEST(FlownMap, StaysWithinItsBoundsOfEffortAndMemory) {
  for (const Flight& flight : flights()) {
    const SensedSpace flown(flight, 3.0, {});
    const agent::WorldMap::Counts counts = flown.map().counts();
    EXPECT_LT(static_cast<double>(counts.windows), 300e3 * flight.duration_s) << flight.name;
    EXPECT_LT(counts.bytes, 30e6) << flight.name;
  }
}

}  // namespace
}  // namespace skein::sensing
