#include "cli/study/box_plot.hpp"

#include <gtest/gtest.h>

#include <random>

#include "cli/testing/xml_check.hpp"

namespace skein::cli {
namespace {

double number(const XmlElement& element, const char* name) { return std::stod(element.attributes.at(name)); }

bool has_class(const XmlElement& element, const std::string& name) {
  const auto found = element.attributes.find("class");
  return found != element.attributes.end() && found->second == name;
}

TEST(BoxPlot, EverythingIsWithinTheAxis) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 300; ++trial) {
    BoxPlot plot{"trial", "score", {}};
    const double offset = static_cast<double>(random() % 3000) - 500.0, size = 1.0 + random() % 2000;
    for (unsigned rows = 1 + random() % 6, r = 0; r < rows; ++r) {
      PlotRow row{"planner " + std::to_string(r), r, {}};
      for (unsigned values = random() % 8, v = 0; v < values; ++v) {
        row.values.push_back({offset + size * static_cast<double>(random() % 1000) / 1000.0, "a flight"});
      }
      plot.rows.push_back(row);
    }
    const auto elements = xml_elements(box_plot_svg(plot));
    double left = 0.0, right = 0.0, bottom = 0.0;
    for (const XmlElement& e : elements) {
      if (has_class(e, "axis")) left = number(e, "x1"), right = number(e, "x2"), bottom = number(e, "y1");
    }
    ASSERT_LT(left, right);
    for (const XmlElement& e : elements) {
      if (e.name == "circle") {
        ASSERT_GE(number(e, "cx"), left - 0.1);
        ASSERT_LE(number(e, "cx"), right + 0.1);
        ASSERT_LE(number(e, "cy"), bottom);
      }
      if (e.name == "rect") {
        ASSERT_GE(number(e, "x"), left - 0.1);
        ASSERT_GE(number(e, "width"), 0.0);
        ASSERT_LE(number(e, "x") + number(e, "width"), right + 0.2);
      }
      if (has_class(e, "whisker") || has_class(e, "median")) {
        for (const char* x : {"x1", "x2"}) {
          ASSERT_GE(number(e, x), left - 0.1);
          ASSERT_LE(number(e, x), right + 0.1);
        }
      }
    }
  }
}

TEST(BoxPlot, TheBoxIsWhereTheQuartilesAre) {
  // On an axis from 0 to 100 whose ends are dots of another row.
  BoxPlot plot{"", "score", {{"ends", 0, {{0.0, ""}, {100.0, ""}}}, {"five", 1, {}}}};
  for (const double value : {10.0, 20.0, 50.0, 60.0, 90.0}) plot.rows[1].values.push_back({value, ""});
  const auto elements = xml_elements(box_plot_svg(plot));
  double left = 0.0, right = 0.0;
  std::vector<XmlElement> boxes, medians, dots;
  for (const XmlElement& e : elements) {
    if (has_class(e, "axis")) left = number(e, "x1"), right = number(e, "x2");
    if (e.name == "rect") boxes.push_back(e);
    if (has_class(e, "median")) medians.push_back(e);
    if (e.name == "circle") dots.push_back(e);
  }
  const auto x_of = [&](double value) { return left + (right - left) * value / 100.0; };
  ASSERT_EQ(boxes.size(), 2u);
  EXPECT_EQ(dots.size(), 7u);
  EXPECT_NEAR(number(boxes[1], "x"), x_of(20.0), 0.06);
  EXPECT_NEAR(number(boxes[1], "width"), x_of(60.0) - x_of(20.0), 0.06);
  EXPECT_NEAR(number(medians[1], "x1"), x_of(50.0), 0.06);
}

TEST(BoxPlot, TextsAreEscapedAndARowMayBeEmpty) {
  const BoxPlot plot{"<a & b>", "\"score\"", {{"x<y>&", 0, {}}, {"exec:./a 'b' && c", 9, {{1.0, "<&>"}}}}};
  const std::string svg = box_plot_svg(plot);
  EXPECT_NO_THROW(xml_elements(svg));
  EXPECT_NE(svg.find("no flight"), std::string::npos);
  EXPECT_NE(svg.find("row c2"), std::string::npos) << "colours repeat";
}

}  // namespace
}  // namespace skein::cli
