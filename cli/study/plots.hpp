// Plots of a study as SVG: rows of dots, and curves over time. The caller gives the axes, so that panels of one
// quantity have the same axis. Colours are CSS classes of report/style.hpp. Pure; any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/study/curves.hpp"
#include "cli/study/statistics.hpp"
#include "report/html.hpp"

namespace skein::cli {

inline constexpr std::size_t kPlotColours = 7;
/// A row with fewer values has no box, because quartiles of so few values are mostly interpolation.
inline constexpr std::size_t kFewestInABox = 5;

/// CSS class of a planner's colour. The classes repeat after kPlotColours planners.
std::string colour_class(std::size_t planner);

struct PlotValue {
  double value = 0.0;
  std::string name;  ///< tooltip
};

struct PlotRow {
  std::string label;
  std::string style;  ///< colour_class(), or "neutral": of no single planner
  std::vector<PlotValue> values;
  /// Confidence interval of the median; drawn instead of a box.
  std::optional<Interval> interval = {};
};

struct DotPlot {
  std::string title;  ///< for screen readers; the page has its own caption
  std::string quantity;
  report::Axis axis;  ///< must contain all values
  std::vector<PlotRow> rows;
  bool boxes = true;  ///< boxes between the quartiles and whiskers to the ends, in rows of kFewestInABox or more values
};

/// Draws each value as a dot and the median as a line. Width 360 (SVG units).
std::string dot_plot_svg(const DotPlot& plot);

struct CurvePlot {
  std::string title;
  report::Axis axis;  ///< of the scores
  std::vector<double> times_s;
  std::vector<ScoreCurve> curves;
  std::vector<std::string> names;  ///< of planners
};

/// Draws medians as lines, bands from the least to the greatest value, and a legend above. Width 440 (SVG units).
std::string curve_plot_svg(const CurvePlot& plot);

/// An entry of a legend in a drawing, with a line or a square as its symbol.
struct LegendEntry {
  std::string style, text;
  bool square = false;
};
/// Draws a legend from `top` downwards, in lines of at most `width`. @param height  returns its height.
std::string legend_svg(const std::vector<LegendEntry>& entries, double left, double top, double width, double& height);

}  // namespace skein::cli
