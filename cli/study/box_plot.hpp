// A panel of box plots as SVG: one row a sample, all its values as dots. Colours are CSS classes of style.hpp.
// Pure; any thread.
#pragma once

#include <string>
#include <vector>

namespace skein::cli {

struct PlotValue {
  double value = 0.0;
  std::string name;  ///< shown when pointed at
};

struct PlotRow {
  std::string label;
  std::size_t colour = 0;  ///< index; there are kPlotColours, then they repeat
  std::vector<PlotValue> values;
};

inline constexpr std::size_t kPlotColours = 7;

struct BoxPlot {
  std::string title;  ///< for those who hear the page; the caption is the page's
  std::string axis;   ///< "score"
  std::vector<PlotRow> rows;
};

/// Box from quartile to quartile with the median, whiskers to the least and the greatest value. Width 360.
std::string box_plot_svg(const BoxPlot& plot);

}  // namespace skein::cli
