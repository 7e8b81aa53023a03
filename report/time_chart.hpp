// Drawings over the time of a run, as SVG: curves, bars of faults, and a lane for each UAV. Colours are CSS classes of
// style.hpp. Pure; any thread.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "report/figures.hpp"

namespace skein::report {

/// A quantity that keeps its value until it changes.
struct TimeCurve {
  std::string name, style;  ///< style: a CSS class
  std::vector<std::pair<double, double>> changes;
};

/// Curves over the time, the faults behind them, and below them the captures of each UAV.
/// @param width  of the drawing, in whose units letters have always the same size.
std::string time_chart_svg(const std::string& title, const std::vector<TimeCurve>& curves, const results::RunData& run,
                           const std::vector<Lane>& lanes, double width);

/// What each UAV did when.
std::string lanes_svg(const std::string& title, const results::RunData& run, const std::vector<Lane>& lanes,
                      double width);

/// How many captures took how long: one bar for each range.
std::string latency_svg(const std::string& title, const Latency& latency);

/// Which UAV a fault is about: its program, or a link that it has a part in.
bool concerns(const results::RunFault& fault, const std::string& uav);

}  // namespace skein::report
