// The pictures and tables of docs/sensing.md are well formed and not empty, and each call draws the same ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <pugixml.hpp>
#include <sstream>

#include "bench/sensing/tables.hpp"
#include "core/types.hpp"

namespace skein::bench {
namespace {

using agent::Space;

/// Expects that each line of a table has as many cells as the line above it.
void expect_table(const std::string& markdown) {
  std::istringstream lines(markdown);
  std::string line;
  std::ptrdiff_t bars = 0;
  int rows = 0;
  while (std::getline(lines, line)) {
    if (line.empty()) {
      bars = 0;
      continue;
    }
    const auto here = std::ranges::count(line, '|');
    EXPECT_TRUE(bars == 0 || here == bars) << line;
    bars = here;
    ++rows;
    EXPECT_TRUE(line.starts_with('|') && line.ends_with('|')) << line;
    EXPECT_EQ(line.find("nan"), std::string::npos) << line;
  }
  EXPECT_GE(rows, 3) << markdown;
}

bool holds(const Squares& squares, Space space) { return std::ranges::count(squares.space, space) > 0; }

void expect_picture(const Picture& picture) {
  const std::string svg = picture_svg(picture);
  EXPECT_LT(svg.size(), 60'000U) << picture.title;
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(svg.c_str())) << picture.title;
  for (const char* style : {"free", "occupied", "unknown", "cut", "route", "bar"}) {
    const std::string path = "//*[@class='" + std::string(style) + "']";
    EXPECT_TRUE(document.select_node(path.c_str())) << style;
  }
  EXPECT_EQ(document.select_nodes("//svg/svg").size(), 2 * picture.rows.size());
}

class SensingPage : public testing::Test {
 protected:
  static const std::vector<SiteStudy>& studies() {
    static const std::vector<SiteStudy> flown = {study_of(loose_box(), {1.0, 8.0}, 1),
                                                 study_of(lattice(), {1.0, 8.0}, 1)};
    return flown;
  }
};

TEST_F(SensingPage, PicturesShowFreeOccupiedAndUnknownSpace) {
  for (const SiteStudy& study : studies()) {
    ASSERT_EQ(study.snapshots.size(), 2U);
    expect_picture(study.level);
    expect_picture(study.upright);
    for (const Squares& squares : {study.upright.rows.back().world, study.level.rows.back().world}) {
      for (const Space space : {Space::unknown, Space::free, Space::occupied}) {
        EXPECT_TRUE(holds(squares, space)) << study.name << static_cast<int>(space);
      }
    }
    EXPECT_TRUE(holds(study.upright.rows.back().today, Space::free)) << study.name;
  }
}

TEST_F(SensingPage, BeamsProveMoreFreeSpaceInALooseBoxThanKeyFrames) {
  const Band& near = studies().front().snapshots.back().bands.front();
  EXPECT_GT(near.world, near.today);
  EXPECT_GT(near.free_m3, 3000.0);
  for (const SiteStudy& study : studies()) {
    const Surface& surface = study.snapshots.back().surface;
    EXPECT_GT(surface.places, 50);
    EXPECT_LT(100 * surface.world_free, surface.places) << "places on the surface of structures are not free";
    EXPECT_GE(surface.world_occupied, surface.today_occupied);
  }
  EXPECT_EQ(studies().front().rays, 16) << "a box so large is not a piece of structure";
}

TEST_F(SensingPage, IsTheSameAtEachCall) {
  const std::vector<SiteStudy> again = {study_of(loose_box(), {1.0, 8.0}, 1)};
  const std::span<const SiteStudy> first(studies().data(), 1);
  EXPECT_EQ(picture_svg(again.front().level), picture_svg(first.front().level));
  EXPECT_EQ(picture_svg(again.front().upright), picture_svg(first.front().upright));
  EXPECT_EQ(space_table(again).markdown, space_table(first).markdown);
  EXPECT_EQ(surface_table(again).markdown, surface_table(first).markdown);
  EXPECT_EQ(message_table(again).markdown, message_table(first).markdown);
}

TEST_F(SensingPage, TablesAreWellFormed) {
  const std::vector<Reach> reaches = {{.member_width_m = 0.05, .one_sweep_m = 3.0}};
  const std::vector<Stop> stops = {{1.0, 0.5}, {2.0, 1.0}};
  for (const Table& table : {space_table(studies()), surface_table(studies()), reach_table(reaches, stops),
                             cost_table(studies()), message_table(studies())}) {
    SCOPED_TRACE(table.name);
    expect_table(table.markdown);
  }
}

TEST(SensingStops, AreLongerTheFasterTheUavFlies) {
  const std::vector<Stop> flown = stops(1);
  ASSERT_EQ(flown.size(), 12U) << "up to 6 m/s";
  for (std::size_t i = 1; i < flown.size(); ++i) EXPECT_GT(flown[i].way_m, flown[i - 1].way_m);
  const double hardest = 0.5 * 36.0 / 4.0;  // with all of the vehicle's acceleration
  EXPECT_GT(flown.back().way_m, hardest);
  EXPECT_LT(flown.back().way_m, 3.0 * hardest);
}

TEST(SensingStops, TheSpeedForAStoppingDistanceIsInterpolated) {
  const std::vector<Stop> flown = {{1.0, 0.5}, {2.0, 2.5}};
  EXPECT_EQ(speed_within(flown, 0.0), 0.0);
  EXPECT_EQ(speed_within(flown, 0.25), 0.5);
  EXPECT_EQ(speed_within(flown, 1.5), 1.5);
  EXPECT_EQ(speed_within(flown, 9.0), 2.0);
  EXPECT_EQ(speed_within({}, 9.0), 0.0);
}

TEST(SensingSlice, ATriangleIsCutAlongItsIntersectionWithThePlane) {
  const Plane plane{.corner_W = {-1.0, -1.0, 2.0}, .width_m = 4.0, .height_m = 4.0};
  const TriangleMesh mesh{.vertices = {{0.0F, 0.0F, 1.0F}, {0.0F, 0.0F, 3.0F}, {2.0F, 0.0F, 1.0F}, {90.0F, 0.0F, 1.0F}},
                          .triangles = {{0, 1, 2}, {0, 2, 3}}};
  const std::vector<Line> lines = cut_of(mesh, plane);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_LT((lines[0].first - Vector2d(1.0, 1.0)).norm() + (lines[0].second - Vector2d(2.0, 1.0)).norm(), 1e-6);
}

TEST(SensingTables, ReplaceTheFormerTablesOfThePage) {
  const std::string page = "a\n[//]: # (table: x)\nold\n[//]: # (end of table)\nb\n";
  const std::string fresh = "a\n[//]: # (table: x)\n\nnew\n\n[//]: # (end of table)\nb\n";
  EXPECT_EQ(with_table(page, {"x", "new\n"}), fresh);
  EXPECT_EQ(with_table(fresh, {"x", "new\n"}), fresh);
  EXPECT_THROW(with_table(page, {"y", "new\n"}), InputError);
  EXPECT_THROW(with_table("[//]: # (table: x)\n", {"x", ""}), InputError);
}

}  // namespace
}  // namespace skein::bench
