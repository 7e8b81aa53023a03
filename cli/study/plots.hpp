// Plots of a study as SVG: rows of dots, and curves over time. Their axes are the caller's, so that panels of one
// quantity have the same. Colours are CSS classes of report/style.hpp. Pure; any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/study/curves.hpp"
#include "cli/study/statistics.hpp"
#include "report/html.hpp"

namespace skein::cli {

inline constexpr std::size_t kPlotColours = 7;
/// With fewer values a row has no box: quartiles of so few are mostly invented.
inline constexpr std::size_t kFewestInABox = 5;

/// The class of a planner's colour; they repeat.
std::string colour_class(std::size_t planner);

struct PlotValue {
  double value = 0.0;
  std::string name;  ///< shown when pointed at
};

struct PlotRow {
  std::string label;
  std::string style;  ///< colour_class(), or "neutral" for what is of no planner
  std::vector<PlotValue> values;
  /// Drawn in the place of a box: where the median is to be looked for.
  std::optional<Interval> interval = {};
};

struct DotPlot {
  std::string title;  ///< for those who hear the page; the caption is the page's
  std::string quantity;
  report::Axis axis;  ///< holds all values
  std::vector<PlotRow> rows;
  bool boxes = true;  ///< of rows with kFewestInABox values: from quartile to quartile, whiskers to the ends
};

/// Every value is a dot, the median a line. Width 360.
std::string dot_plot_svg(const DotPlot& plot);

struct CurvePlot {
  std::string title;
  report::Axis axis;  ///< of the scores
  std::vector<double> times_s;
  std::vector<ScoreCurve> curves;
  std::vector<std::string> names;  ///< of planners
};

/// Medians as lines, in bands from the least to the greatest; a legend above. Width 440.
std::string curve_plot_svg(const CurvePlot& plot);

/// An entry of a legend within a drawing: a line, or a square where it is of `points`.
struct LegendEntry {
  std::string style, text;
  bool square = false;
};
/// In lines of `width`, from `top` on. @param height  is set to what they take.
std::string legend_svg(const std::vector<LegendEntry>& entries, double left, double top, double width, double& height);

}  // namespace skein::cli
