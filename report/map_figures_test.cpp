// MapFigures of maps that are small enough to be counted by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/types.hpp"
#include "report/figures.hpp"
#include "report/page_parts.hpp"

namespace skein::report {
namespace {

/// The whole world is known, except the part with x and y below 0.
const std::string kMostOfTheWorld =
    "# Octomap OcTree binary file\n# comment\n#\nid OcTree\nsize 7\nres 0.5\ndata\n" + std::string("\x64\x54", 2);

TEST(MapFigures, TheKnownShareOfTheBoxesIsThatOfTheirVolume) {
  results::RunRecord run;
  run.uavs = {"a", "b"};
  run.maps = {kMostOfTheWorld, ""};
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

// The colours divide the height of the boxes, but at least one metre. The legend must do the same.
TEST(MapsSection, TheLegendEndsWithTheGreatestHeightOfTheColours) {
  results::RunRecord run;
  run.uavs = {"a"};
  run.explorer = {true};
  run.maps = {kMostOfTheWorld};
  for (const double height_m : {0.1, 0.3, 1.0, 2.0, 8.0, 40.0}) {
    results::RunBox box;
    box.center = {1.0, 1.0, 0.5 * height_m};
    box.size = {2.0, 2.0, height_m};
    run.boxes = {box};
    const std::string html = maps_section(RunPage(run));
    const std::string last = "swatch m5\"></span>occupied up to ";
    ASSERT_NE(html.find(last), std::string::npos) << html;
    EXPECT_EQ(std::stod(html.substr(html.find(last) + last.size())), std::max(1.0, height_m)) << html;
  }
}

}  // namespace
}  // namespace skein::report
