// Charts over the time of a run, as SVG: curves, bars for faults, and a lane for each UAV. The style sheets in
// style.hpp define the colours. Charts over time fill windows of any width: their letters keep their size, and only
// the time axis is stretched. Pure; any thread.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "report/figures.hpp"

namespace skein::report {

/// A quantity that keeps its value until it changes.
struct TimeCurve {
  std::string name, style;                         ///< style: a CSS class
  std::vector<std::pair<double, double>> changes;  ///< time [s] and new value, ascending
};

/// Curves over time, with faults behind them and, below, the captures of each UAV.
std::string time_chart_svg(const std::string& title, const std::vector<TimeCurve>& curves,
                           const results::RunRecord& run, const std::vector<Lane>& lanes);

/// A lane for each UAV: when it flew or stood still, its links to the station, its captures, and undelivered captures.
std::string lanes_svg(const std::string& title, const results::RunRecord& run, const std::vector<Lane>& lanes);

/// Histogram of delivery delays: a bar for each range of delays, and one for captures that were never delivered.
std::string latency_svg(const std::string& title, const Latency& latency);

/// Whether the target of a fault names this UAV, as its program or as one end of a link.
bool concerns(const results::RunFault& fault, const std::string& uav);

}  // namespace skein::report
