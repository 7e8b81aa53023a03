// What MapFigures says of maps that are small enough to count by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/types.hpp"
#include "report/figures.hpp"

namespace skein::report {
namespace {

TEST(MapFigures, ShareOfTheBoxesIsThatOfTheirVolume) {
  // All of the world is known, but for what has x and y below 0.
  results::RunData run;
  run.uavs = {"a", "b"};
  run.maps = {
      "# Octomap OcTree binary file\n# comment\n#\nid OcTree\nsize 7\nres 0.5\ndata\n" + std::string("\x64\x54", 2),
      ""};
  results::RunBox box;
  box.center = {3.0, 5.0, 20.0};
  box.size = {20.0, 30.0, 24.0};
  run.boxes = {box, box};
  const auto figures = map_figures(run);
  ASSERT_TRUE(figures[0]);
  EXPECT_FALSE(figures[1]);
  EXPECT_NEAR(*figures[0]->known_share, 1.0 - (7.0 / 20.0) * (10.0 / 30.0), 0.02);
  EXPECT_NEAR(figures[0]->occupied_m3, std::pow(16384.0, 3), 1.0);
  EXPECT_NEAR(figures[0]->free_m3, 5.0 * std::pow(16384.0, 3), 1.0);
}

}  // namespace
}  // namespace skein::report
