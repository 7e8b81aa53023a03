#include "cli/study/curves.hpp"

#include <algorithm>

namespace skein::cli {
namespace {

constexpr std::size_t kCurveSteps = 240;  ///< more than a drawing can show

}  // namespace

std::vector<double> curve_times(const Study& study) {
  double end_s = 0.0;
  for (const FlightEntry& flight : study.flights) {
    if (flight.figures && flight.tables) end_s = std::max(end_s, flight.tables->end_s);
  }
  std::vector<double> times_s;
  for (std::size_t i = 0; i <= kCurveSteps; ++i) {
    times_s.push_back(end_s * static_cast<double>(i) / static_cast<double>(kCurveSteps));
  }
  return times_s;
}

std::vector<ScoreCurve> score_curves(const Study& study, std::size_t scenario, const std::vector<double>& times_s) {
  std::vector<ScoreCurve> curves;
  for (std::size_t p = 0; p < study.planners.size(); ++p) {
    std::vector<const FlightTables*> flights;
    for (const FlightEntry* flight : study.cell(p, scenario)) {
      if (flight->tables && !flight->tables->scores.empty()) flights.push_back(&*flight->tables);
    }
    if (flights.empty()) continue;
    ScoreCurve curve{p, flights.size(), {}, {}, {}};
    for (const double time_s : times_s) {
      std::vector<double> scores;
      for (const FlightTables* flight : flights) scores.push_back(flight->score_at(time_s));
      const Spread spread = spread_of(std::move(scores));
      curve.median.push_back(spread.median);
      curve.least.push_back(spread.min);
      curve.greatest.push_back(spread.max);
    }
    curves.push_back(std::move(curve));
  }
  return curves;
}

}  // namespace skein::cli
