// Tests the sections with drawings of the scene. All points are far apart, so that each has a dot of its own.
#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <pugixml.hpp>
#include <random>

#include "report/html.hpp"
#include "report/page_parts.hpp"

namespace skein::report {
namespace {

/// One drawing of a section.
struct Panel {
  std::string title, small;
  std::string live;  ///< attribute data-live: kind of the drawing with which report.js replaces this one
  std::map<std::string, std::ptrdiff_t> dots;  ///< number of dots by colour: "q0", "k3"
  bool operator==(const Panel&) const = default;
};

void PrintTo(const Panel& panel, std::ostream* out) {
  *out << panel.title << " (" << panel.small << ")" << (panel.live.empty() ? "" : " live:" + panel.live);
  for (const auto& [colour, dots] : panel.dots) *out << " " << colour << "=" << dots;
}

/// A parsed section.
class Section {
 public:
  explicit Section(const std::string& html) { EXPECT_TRUE(document_.load_buffer(html.data(), html.size())) << html; }

  std::vector<Panel> panels() const {
    std::vector<Panel> all;
    for (const pugi::xml_node& div : root().children("div")) {
      for (const pugi::xml_node& figure : div.children("figure")) all.push_back(panel(figure));
    }
    return all;
  }
  /// For each entry of the legend: the style of its swatch, and its text.
  std::vector<std::pair<std::string, std::string>> legend() const {
    std::vector<std::pair<std::string, std::string>> entries;
    for (const pugi::xml_node& entry : root().child("ul").children("li")) {
      entries.emplace_back(entry.child("span").attribute("style").value(), entry.text().get());
    }
    return entries;
  }

 private:
  pugi::xml_node root() const { return document_.child("section"); }
  static Panel panel(const pugi::xml_node& figure) {
    const pugi::xml_node caption = figure.child("figcaption");
    Panel panel{caption.text().get(), caption.child("small").text().get(), figure.attribute("data-live").value(), {}};
    const pugi::xml_node points = figure.child("svg").find_child_by_attribute("g", "class", "points");
    for (const pugi::xml_node& path : points.children("path")) {
      const std::string_view data = path.attribute("d").value();  // each dot is a line of zero length: "h0"
      panel.dots[path.attribute("class").value()] = std::ranges::count(data, 'h');
    }
    return panel;
  }

  pugi::xml_document document_;
};

/// A run with one point that lost no score, and points that lost some for random causes. Some causes have no point.
results::RunRecord lossy_run(std::mt19937& random) {
  results::RunRecord run;
  run.causes_known = true;
  const auto add = [&](std::optional<std::size_t> cause, double loss) {
    const auto i = static_cast<double>(run.points.size());
    results::RunPoint point;
    point.p_W = {10.0 * std::fmod(i, 7.0), 10.0 * std::floor(i / 7.0), 5.0};
    point.score = 0.01 * static_cast<double>(random() % 101);
    point.loss = loss;
    point.cause = cause;
    run.points.push_back(point);
  };
  add(std::nullopt, 0.0);
  const auto has_points = random();  // one bit for each cause
  for (int i = 0; i < 40; ++i) {
    const std::size_t cause = random() % results::kCauses.size();
    if ((has_points >> cause & 1U) != 0) add(cause, 0.5 * static_cast<double>(1 + random() % 9));
  }
  return run;
}

TEST(PlacesSection, HasForEachCauseADrawingThatHighlightsItsPoints) {
  std::mt19937 random(21);
  for (int trial = 0; trial < 40; ++trial) {
    const results::RunRecord run = lossy_run(random);
    std::vector<Panel> expected = {{"All causes", "plan", "", {}}};
    std::vector<std::pair<std::string, std::string>> legend;
    const auto total = static_cast<std::ptrdiff_t>(run.points.size());
    for (std::size_t cause = 0; cause < results::kCauses.size(); ++cause) {
      std::ptrdiff_t points = 0;
      double loss = 0.0;
      for (const results::RunPoint& point : run.points) {
        if (point.cause != cause) continue;
        ++points;
        loss += point.loss;
      }
      if (points == 0) continue;
      const std::string title(results::kCauses[cause].title), colour = fmt::format("k{}", cause);
      legend.emplace_back("background:var(--" + colour + ")", title);
      expected.front().dots[colour] = points;
      expected.push_back({title, fmt::format("{} points, {} score", points, fixed(loss, 1)), "", {{colour, points}}});
      expected.back().dots["q0"] = total - points;  // the other points stay pale
    }
    expected.front().dots["q0"] = 1;
    legend.emplace_back("background:var(--q0)", "nothing lost");
    const Section section(places_section(RunPage(run)));
    EXPECT_EQ(section.panels(), expected);
    EXPECT_EQ(section.legend(), legend);
  }
}

TEST(PlacesSection, IgnoresTracks) {
  std::mt19937 random(22);
  RunPage page(lossy_run(random));
  const std::string without = places_section(page);
  page.picture.tracks.push_back({"a", false, {{0.0, 0.0, 5.0}, {900.0, 0.0, 5.0}}});
  EXPECT_EQ(places_section(page), without) << "the section shows neither the tracks nor their extent";
}

TEST(PlacesSection, IsEmptyIfNoCausesAreKnown) {
  std::mt19937 random(23);
  results::RunRecord run = lossy_run(random);
  run.causes_known = false;
  EXPECT_EQ(places_section(RunPage(run)), "");
}

TEST(ViewsSection, DrawsTheDataThatTheRunHas) {
  RunPage nothing{results::RunRecord()};
  EXPECT_NE(views_section(nothing).find("Nothing is known about the scene"), std::string::npos);
  EXPECT_TRUE(Section(views_section(nothing)).panels().empty());

  RunPage points = nothing, boxes = nothing, track = nothing;
  points.picture.points.push_back({{1.0, 2.0, 3.0}, 0.5});
  boxes.picture.boxes.push_back(corners_of({1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}, Eigen::Matrix3d::Identity()));
  track.picture.tracks.push_back({"a", false, {{0.0, 0.0, 5.0}, {9.0, 0.0, 5.0}}});
  for (const RunPage& page : {points, boxes, track}) {
    const std::string html = views_section(page);
    EXPECT_EQ(html.find("Nothing is known"), std::string::npos);
    ASSERT_EQ(Section(html).panels().size(), 4u);
  }
}

TEST(ViewsSection, EachViewHasItsDirectionAndOnlyTheObliqueOneCanBeTurned) {
  const Vector3d offset = 30.0 * Vector3d::Ones();
  for (int axis = 0; axis < 3; ++axis) {
    RunPage page{results::RunRecord()};
    for (const double apart : {0.0, 20.0}) page.picture.points.push_back({offset + apart * Vector3d::Unit(axis), 0.0});
    const auto dots = [&](int along) -> std::ptrdiff_t { return axis == along ? 1 : 2; };  // one dot hides the other
    const std::vector<Panel> expected = {{"From the south-south-east", "", "3d", {{"q0", 2}}},
                                         {"Plan", "", "", {{"q0", dots(2)}}},
                                         {"Elevation from the south", "", "", {{"q0", dots(1)}}},
                                         {"Elevation from the east", "", "", {{"q0", dots(0)}}}};
    EXPECT_EQ(Section(views_section(page)).panels(), expected) << "the points lie apart along axis " << axis;
  }
}

}  // namespace
}  // namespace skein::report
