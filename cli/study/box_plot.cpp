#include "cli/study/box_plot.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "cli/study/figures.hpp"
#include "cli/study/html.hpp"

namespace skein::cli {
namespace {

constexpr double kWidth = 360.0, kLeft = 14.0, kRight = 18.0, kTop = 4.0, kRow = 44.0, kAxis = 36.0;
constexpr double kLabelAt = 14.0, kBoxAt = 30.0, kHalfBox = 8.0;  // within a row
constexpr std::size_t kLabelLength = 48;

Axis axis_of(const BoxPlot& plot) {
  double low = 0.0, high = 0.0;
  bool first = true;
  for (const PlotRow& row : plot.rows) {
    for (const PlotValue& value : row.values) {
      low = first ? value.value : std::min(low, value.value);
      high = first ? value.value : std::max(high, value.value);
      first = false;
    }
  }
  return nice_axis(low, high, 5);
}

std::string line(double x1, double y1, double x2, double y2, const std::string& style) {
  return fmt::format("<line class=\"{}\" x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"/>\n", style, coordinate(x1),
                     coordinate(y1), coordinate(x2), coordinate(y2));
}

std::string row_svg(const PlotRow& row, const Axis& axis, double top) {
  const auto x_of = [&](double value) { return kLeft + axis.share(value) * (kWidth - kLeft - kRight); };
  const double y = top + kBoxAt;
  std::string svg = fmt::format("<g class=\"row c{}\">\n<text class=\"name\" x=\"{}\" y=\"{}\">{}</text>\n",
                                row.colour % kPlotColours, coordinate(kLeft), coordinate(top + kLabelAt),
                                escaped(shortened(row.label, kLabelLength)));
  if (row.values.empty()) {
    return svg + fmt::format("<text class=\"tick\" x=\"{}\" y=\"{}\">no flight</text>\n</g>\n", coordinate(kLeft),
                             coordinate(y + 4.0));
  }
  std::vector<double> values;
  for (const PlotValue& value : row.values) values.push_back(value.value);
  const Spread spread = spread_of(values);
  svg += line(x_of(spread.min), y, x_of(spread.q1), y, "whisker");
  svg += line(x_of(spread.q3), y, x_of(spread.max), y, "whisker");
  svg += line(x_of(spread.min), y - 4.0, x_of(spread.min), y + 4.0, "whisker");
  svg += line(x_of(spread.max), y - 4.0, x_of(spread.max), y + 4.0, "whisker");
  svg +=
      fmt::format("<rect class=\"box\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>\n", coordinate(x_of(spread.q1)),
                  coordinate(y - kHalfBox), coordinate(x_of(spread.q3) - x_of(spread.q1)), coordinate(2.0 * kHalfBox));
  svg += line(x_of(spread.median), y - kHalfBox, x_of(spread.median), y + kHalfBox, "median");
  for (std::size_t i = 0; i < row.values.size(); ++i) {
    const double beside = 4.0 * (static_cast<double>(i % 3) - 1.0);  // equal values stay apart
    svg += fmt::format("<circle class=\"dot\" cx=\"{}\" cy=\"{}\" r=\"2.6\"><title>{}</title></circle>\n",
                       coordinate(x_of(row.values[i].value)), coordinate(y + beside), escaped(row.values[i].name));
  }
  return svg + "</g>\n";
}

}  // namespace

std::string box_plot_svg(const BoxPlot& plot) {
  const Axis axis = axis_of(plot);
  const double bottom = kTop + kRow * static_cast<double>(plot.rows.size()) + 4.0, height = bottom + kAxis;
  std::string svg = fmt::format(
      "<svg class=\"plot\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\" "
      "xmlns=\"http://www.w3.org/2000/svg\">\n",
      coordinate(kWidth), coordinate(height), escaped(plot.title));
  for (const double tick : axis.ticks()) {
    const double x = kLeft + axis.share(tick) * (kWidth - kLeft - kRight);
    svg += line(x, kTop, x, bottom, "grid");
    svg += fmt::format("<text class=\"tick middle\" x=\"{}\" y=\"{}\">{}</text>\n", coordinate(x),
                       coordinate(bottom + 14.0), axis.label(tick));
  }
  svg += line(kLeft, bottom, kWidth - kRight, bottom, "axis");
  svg += fmt::format("<text class=\"tick middle\" x=\"{}\" y=\"{}\">{}</text>\n",
                     coordinate(0.5 * (kLeft + kWidth - kRight)), coordinate(bottom + 29.0), escaped(plot.axis));
  for (std::size_t i = 0; i < plot.rows.size(); ++i) {
    svg += row_svg(plot.rows[i], axis, kTop + kRow * static_cast<double>(i));
  }
  return svg + "</svg>\n";
}

}  // namespace skein::cli
