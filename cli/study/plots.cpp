#include "cli/study/plots.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "cli/study/figures.hpp"

namespace skein::cli {
namespace {

using namespace report;

constexpr double kDotWidth = 360.0, kDotLeft = 14.0, kDotRight = 18.0, kDotTop = 4.0, kRow = 44.0, kAxisRoom = 36.0;
constexpr double kLabelAt = 14.0, kBoxAt = 30.0, kHalfBox = 8.0;  // within a row
constexpr std::size_t kLabelLength = 48;
constexpr double kCurveWidth = 440.0, kCurveLeft = 44.0, kCurveRight = 14.0, kCurveHeight = 210.0;
constexpr double kLetter = 6.1, kLegendLine = 15.0, kLegendMark = 20.0, kLegendGap = 14.0;  ///< letter: width at 11 px

std::string line_svg(double x1, double y1, double x2, double y2, const std::string& style) {
  return fmt::format("<line class=\"{}\" x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"/>\n", style, coordinate(x1),
                     coordinate(y1), coordinate(x2), coordinate(y2));
}

std::string text_svg(double x, double y, const std::string& style, const std::string& text) {
  return fmt::format("<text class=\"{}\" x=\"{}\" y=\"{}\">{}</text>\n", style, coordinate(x), coordinate(y),
                     escaped(text));
}

std::string open_plot(const std::string& style, const std::string& title, double width, double height) {
  return fmt::format(
      "<svg class=\"{}\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\" "
      "xmlns=\"http://www.w3.org/2000/svg\">\n",
      style, coordinate(width), coordinate(height), escaped(title));
}

/// Draws one row, below `top`.
class RowDrawing {
 public:
  RowDrawing(const DotPlot& plot, const PlotRow& row, double top) : plot_(plot), row_(row), y_(top + kBoxAt) {
    for (const PlotValue& value : row.values) values_.push_back(value.value);
  }

  static double x_of(const Axis& axis, double value) {
    return kDotLeft + axis.share(value) * (kDotWidth - kDotLeft - kDotRight);
  }

  std::string svg() const {
    std::string svg = text_svg(kDotLeft, y_ - kBoxAt + kLabelAt, "name", shortened(row_.label, kLabelLength));
    if (values_.empty()) return svg + text_svg(kDotLeft, y_ + 4.0, "tick", "no flight");
    const Spread spread = spread_of(values_);
    if (row_.interval) {
      svg += line_svg(x(row_.interval->low), y_, x(row_.interval->high), y_, style("interval"));
    } else if (plot_.boxes && values_.size() >= kFewestInABox) {
      svg += box(spread);
    }
    return svg + dots() +
           line_svg(x(spread.median), y_ - kHalfBox - 2.0, x(spread.median), y_ + kHalfBox + 2.0, style("median"));
  }

 private:
  double x(double value) const { return x_of(plot_.axis, value); }
  std::string style(const std::string& what) const { return what + " " + row_.style; }

  std::string box(const Spread& spread) const {
    std::string svg = line_svg(x(spread.min), y_, x(spread.q1), y_, style("whisker")) +
                      line_svg(x(spread.q3), y_, x(spread.max), y_, style("whisker"));
    for (const double end : {spread.min, spread.max}) {
      svg += line_svg(x(end), y_ - 4.0, x(end), y_ + 4.0, style("whisker"));
    }
    return svg + fmt::format("<rect class=\"{}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>\n", style("box"),
                             coordinate(x(spread.q1)), coordinate(y_ - kHalfBox),
                             coordinate(x(spread.q3) - x(spread.q1)), coordinate(2.0 * kHalfBox));
  }

  std::string dots() const {
    std::string svg;
    for (std::size_t i = 0; i < row_.values.size(); ++i) {
      const double beside = 4.0 * (static_cast<double>(i % 3) - 1.0);  // separates equal values
      svg +=
          fmt::format("<circle class=\"{}\" cx=\"{}\" cy=\"{}\" r=\"2.6\"><title>{}</title></circle>\n", style("dot"),
                      coordinate(x(row_.values[i].value)), coordinate(y_ + beside), escaped(row_.values[i].name));
    }
    return svg;
  }

  const DotPlot& plot_;
  const PlotRow& row_;
  double y_;
  std::vector<double> values_;
};

/// Positions of times and scores in a plot of curves whose panel begins at `top`.
struct CurveFrame {
  double top, end_s;
  Axis axis;

  double left() const { return kCurveLeft; }
  double right() const { return kCurveWidth - kCurveRight; }
  double bottom() const { return top + kCurveHeight; }
  double x(double time_s) const { return left() + (right() - left()) * time_s / end_s; }
  double y(double score) const { return bottom() - kCurveHeight * axis.share(score); }

  std::string grid() const {
    std::string svg;
    for (const double tick : axis.ticks()) {
      svg += line_svg(left(), y(tick), right(), y(tick), "grid") +
             text_svg(left() - 5.0, y(tick) + 3.5, "tick end", axis.label(tick));
    }
    const double step = nice_axis(0.0, end_s, 8).step;
    const Axis times{0.0, step * std::floor(end_s / step + 1e-9), step};
    for (const double tick : times.ticks()) {
      svg += line_svg(x(tick), top, x(tick), bottom(), "grid") +
             text_svg(x(tick), bottom() + 13.0, "tick middle", times.label(tick));
    }
    return svg + line_svg(left(), bottom(), right(), bottom(), "axis") +
           line_svg(left(), top, left(), bottom(), "axis") + text_svg(left() - 5.0, top - 10.0, "tick end", "score") +
           text_svg(0.5 * (left() + right()), bottom() + 28.0, "tick middle", "simulated time [s]");
  }
};

std::string curve_svg(const CurvePlot& plot, const ScoreCurve& curve, const CurveFrame& frame) {
  std::string line, band, back;
  for (std::size_t i = 0; i < plot.times_s.size(); ++i) {
    const std::string x = coordinate(frame.x(plot.times_s[i]));
    line += (i == 0 ? "M" : " ") + x + " " + coordinate(frame.y(curve.median[i]));
    band += (i == 0 ? "M" : " ") + x + " " + coordinate(frame.y(curve.greatest[i]));
    back = " " + x + " " + coordinate(frame.y(curve.least[i])) + back;
  }
  const std::string colour = colour_class(curve.planner);
  const std::string title =
      fmt::format("<title>{}: median of {} flights</title>", escaped(plot.names[curve.planner]), curve.flights);
  return fmt::format("<path class=\"band {0}\" d=\"{1}{2}Z\"/>\n<path class=\"curve {0}\" d=\"{3}\">{4}</path>\n",
                     colour, band, back, line, title);
}

}  // namespace

std::string colour_class(std::size_t planner) { return fmt::format("c{}", planner % kPlotColours); }

std::string dot_plot_svg(const DotPlot& plot) {
  const double bottom = kDotTop + kRow * static_cast<double>(plot.rows.size()) + 4.0;
  std::string svg = open_plot("plot", plot.title, kDotWidth, bottom + kAxisRoom);
  for (const double tick : plot.axis.ticks()) {
    const double x = RowDrawing::x_of(plot.axis, tick);
    const bool zero = plot.axis.low < 0.0 && std::abs(tick) < 1e-6 * plot.axis.step;
    svg += line_svg(x, kDotTop, x, bottom, zero ? "zero" : "grid") +
           text_svg(x, bottom + 14.0, "tick middle", plot.axis.label(tick));
  }
  svg += line_svg(kDotLeft, bottom, kDotWidth - kDotRight, bottom, "axis") +
         text_svg(0.5 * (kDotLeft + kDotWidth - kDotRight), bottom + 29.0, "tick middle", plot.quantity);
  for (std::size_t i = 0; i < plot.rows.size(); ++i) {
    svg += RowDrawing(plot, plot.rows[i], kDotTop + kRow * static_cast<double>(i)).svg();
  }
  return svg + "</svg>\n";
}

std::string curve_plot_svg(const CurvePlot& plot) {
  std::vector<LegendEntry> entries;
  for (const ScoreCurve& curve : plot.curves) {
    entries.push_back({"curve " + colour_class(curve.planner), plot.names[curve.planner]});
  }
  double legend_height = 0.0;
  const std::string legend =
      legend_svg(entries, kCurveLeft, 2.0, kCurveWidth - kCurveLeft - kCurveRight, legend_height);
  const double end_s = plot.times_s.empty() || plot.times_s.back() <= 0.0 ? 1.0 : plot.times_s.back();
  const CurveFrame frame{legend_height + 26.0, end_s, plot.axis};
  std::string svg =
      open_plot("plot curves", plot.title, kCurveWidth, frame.bottom() + kAxisRoom) + frame.grid() + legend;
  for (const ScoreCurve& curve : plot.curves) svg += curve_svg(plot, curve, frame);
  return svg + "</svg>\n";
}

std::string legend_svg(const std::vector<LegendEntry>& entries, double left, double top, double width, double& height) {
  const auto most = static_cast<std::size_t>((width - kLegendMark) / kLetter);
  std::string svg;
  double x = left, y = top;
  for (const LegendEntry& entry : entries) {
    const std::string text = shortened(entry.text, most);
    const double wide = kLegendMark + kLetter * static_cast<double>(text.size()) + kLegendGap;
    if (x > left && x + wide - kLegendGap > left + width) {
      x = left;
      y += kLegendLine;
    }
    svg += entry.square
               ? fmt::format("<rect class=\"{}\" x=\"{}\" y=\"{}\" width=\"9\" height=\"9\"/>\n", entry.style,
                             coordinate(x + 3.0), coordinate(y + 3.0))
               : fmt::format("<path class=\"{}\" d=\"M{} {}h15\"/>\n", entry.style, coordinate(x), coordinate(y + 7.5));
    svg += text_svg(x + kLegendMark, y + 11.0, "name", text);
    x += wide;
  }
  height = entries.empty() ? 0.0 : y + kLegendLine - top;
  return svg;
}

}  // namespace skein::cli
