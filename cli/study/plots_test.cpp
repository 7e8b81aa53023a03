#include "cli/study/plots.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <sstream>

#include "report/testing/xml_check.hpp"

namespace skein::cli {
namespace {

using report::xml_elements;
using report::XmlElement;

double number(const XmlElement& element, const char* name) { return std::stod(element.attributes.at(name)); }

bool has_class(const XmlElement& element, const std::string& name) {
  const auto found = element.attributes.find("class");
  return found != element.attributes.end() && (found->second + " ").starts_with(name + " ");
}

std::vector<XmlElement> of_class(const std::vector<XmlElement>& elements, const std::string& name) {
  std::vector<XmlElement> found;
  std::ranges::copy_if(elements, std::back_inserter(found), [&](const XmlElement& e) { return has_class(e, name); });
  return found;
}

/// A random plot with rows of values, some of them without any, whose axis ends at round numbers.
DotPlot odd_plot(std::mt19937& random) {
  DotPlot plot{"trial", "score", {}, {}, random() % 3 > 0};
  const double offset = static_cast<double>(random() % 3000) - 500.0, size = 1.0 + static_cast<double>(random() % 2000);
  for (unsigned rows = 1 + random() % 6, r = 0; r < rows; ++r) {
    PlotRow row{"planner " + std::to_string(r), colour_class(r), {}};
    for (unsigned values = random() % 8, v = 0; v < values; ++v) {
      row.values.push_back({offset + size * static_cast<double>(random() % 1000) / 1000.0, "a flight"});
    }
    if (!row.values.empty() && random() % 2 == 0) row.interval = Interval{offset, offset + size};
    plot.rows.push_back(row);
  }
  plot.axis = report::nice_axis(offset, offset + size);
  return plot;
}

TEST(DotPlot, EveryMarkIsWithinTheAxis) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 300; ++trial) {
    const auto elements = xml_elements(dot_plot_svg(odd_plot(random)));
    const XmlElement axis = of_class(elements, "axis").at(0);
    const double left = number(axis, "x1"), right = number(axis, "x2"), bottom = number(axis, "y1");
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
      if (has_class(e, "whisker") || has_class(e, "median") || has_class(e, "interval")) {
        for (const char* x : {"x1", "x2"}) {
          ASSERT_GE(number(e, x), left - 0.1);
          ASSERT_LE(number(e, x), right + 0.1);
        }
      }
    }
  }
}

TEST(DotPlot, ABoxNeedsFiveValuesAndEveryRowHasItsDotsAndItsMedian) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 300; ++trial) {
    const DotPlot plot = odd_plot(random);
    std::size_t boxes = 0, dots = 0, medians = 0, intervals = 0;
    for (const PlotRow& row : plot.rows) {
      dots += row.values.size();
      medians += row.values.empty() ? 0 : 1;
      intervals += row.interval ? 1 : 0;
      boxes += plot.boxes && !row.interval && row.values.size() >= 5 ? 1 : 0;
    }
    const auto elements = xml_elements(dot_plot_svg(plot));
    ASSERT_EQ(of_class(elements, "box").size(), boxes);
    ASSERT_EQ(of_class(elements, "dot").size(), dots);
    ASSERT_EQ(of_class(elements, "median").size(), medians);
    ASSERT_EQ(of_class(elements, "interval").size(), intervals);
  }
}

TEST(DotPlot, TheBoxIsWhereTheQuartilesAre) {
  DotPlot plot{"", "score", {0.0, 100.0, 20.0}, {{"five", "c1", {}}}};
  for (const double value : {10.0, 20.0, 50.0, 60.0, 90.0}) plot.rows[0].values.push_back({value, ""});
  const auto elements = xml_elements(dot_plot_svg(plot));
  const XmlElement axis = of_class(elements, "axis").at(0), box = of_class(elements, "box").at(0);
  const double left = number(axis, "x1"), right = number(axis, "x2");
  const auto x_of = [&](double value) { return left + (right - left) * value / 100.0; };
  EXPECT_NEAR(number(box, "x"), x_of(20.0), 0.06);
  EXPECT_NEAR(number(box, "width"), x_of(60.0) - x_of(20.0), 0.11);
  EXPECT_NEAR(number(of_class(elements, "median").at(0), "x1"), x_of(50.0), 0.06);
}

TEST(DotPlot, TextsAreEscapedAndARowMayBeEmpty) {
  const DotPlot plot{"<a & b>",
                     "\"score\"",
                     {-1.0, 1.0, 0.5},
                     {{"x<y>&", "neutral", {}}, {"exec:./a 'b' && c", colour_class(9), {{1.0, "<&>"}}}}};
  const std::string svg = dot_plot_svg(plot);
  EXPECT_EQ(of_class(xml_elements(svg), "zero").size(), 1u);
  EXPECT_NE(svg.find("no flight"), std::string::npos);
  EXPECT_NE(svg.find("dot c2"), std::string::npos) << "the colours repeat after the last one";
}

/// The points of an SVG path like "M1 2 3 4 ...".
std::vector<std::pair<double, double>> points_of(std::string data) {
  std::ranges::replace_if(
      data, [](char c) { return c == 'M' || c == 'Z'; }, ' ');
  std::istringstream in(data);
  std::vector<std::pair<double, double>> points;
  for (double x = 0.0, y = 0.0; in >> x >> y;) points.emplace_back(x, y);
  return points;
}

TEST(CurvePlot, MediansAreWithinTheirBandsAndBothWithinTheAxes) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 100; ++trial) {
    CurvePlot plot{
        "t", report::nice_axis(0.0, 1000.0), {}, {}, {"a <b>", "a name that is as long as names can be & more", "c"}};
    for (std::size_t i = 0; i < 50; ++i) plot.times_s.push_back(3.0 * static_cast<double>(i));
    for (std::size_t p = 0; p < 1 + random() % 3; ++p) {
      ScoreCurve curve{p, 3, {}, {}, {}};
      for (std::size_t i = 0; i < 50; ++i) {
        curve.least.push_back(static_cast<double>(random() % 300));
        curve.median.push_back(curve.least.back() + static_cast<double>(random() % 300));
        curve.greatest.push_back(curve.median.back() + static_cast<double>(random() % 300));
      }
      plot.curves.push_back(curve);
    }
    const auto elements = xml_elements(curve_plot_svg(plot));
    const XmlElement axis = of_class(elements, "axis").at(0);
    const double left = number(axis, "x1"), right = number(axis, "x2"), bottom = number(axis, "y1");
    auto curves = of_class(elements, "curve");
    const auto bands = of_class(elements, "band");
    ASSERT_EQ(bands.size(), plot.curves.size());
    ASSERT_EQ(curves.size(), 2 * plot.curves.size()) << "each curve has a line in the plot and one in the legend";
    curves.erase(curves.begin(), curves.begin() + static_cast<std::ptrdiff_t>(plot.curves.size()));
    for (std::size_t i = 0; i < bands.size(); ++i) {
      const auto line = points_of(curves[i].attributes.at("d")), band = points_of(bands[i].attributes.at("d"));
      ASSERT_EQ(line.size(), 50u);
      ASSERT_EQ(band.size(), 100u);
      for (std::size_t k = 0; k < line.size(); ++k) {
        ASSERT_LE(band[k].second, line[k].second);
        ASSERT_GE(band[99 - k].second, line[k].second);
        ASSERT_EQ(band[99 - k].first, line[k].first);
        ASSERT_LE(band[99 - k].second, bottom);
        ASSERT_GE(line[k].first, left);
        ASSERT_LE(line[k].first, right);
      }
    }
  }
}

}  // namespace
}  // namespace skein::cli
