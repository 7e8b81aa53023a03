#include "cli/study/worlds.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <tuple>

#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "report/html.hpp"

namespace skein::cli {
namespace {

constexpr std::size_t kWorst = 10;
constexpr double kTenth = 0.1;
constexpr std::size_t kLongestPlanner = 24;

/// Key by which flights are sorted: the greater, the worse.
std::tuple<bool, int, int, double> badness(const FlightEntry& flight) {
  if (!flight.figures) return {true, 0, 0, 0.0};
  return {false, flight.figures->collisions, flight.figures->frozen_uavs.value_or(0),
          -flight.figures->attainable_percent.value_or(0.0)};
}

/// The tenth percentile, interpolated like the quartiles of Spread; 0 for an empty sample.
double tenth_percentile(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::ranges::sort(values);
  const double at = kTenth * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (at - std::floor(at)) * (values[above] - values[below]);
}

std::string text_of(const Study& study, const FlightEntry& flight) {
  std::string figures = "failed: " + flight.problem;
  if (flight.figures) {
    figures = fmt::format("{:>5} %, {}, {} frozen", report::fixed(flight.figures->attainable_percent, 1),
                          counted(static_cast<std::size_t>(flight.figures->collisions), "collision"),
                          flight.figures->frozen_uavs.value_or(0));
  }
  return fmt::format("  {:<14}{:<12}{}\n    {}\n", study.scenarios[flight.scenario], study.planners[flight.planner],
                     figures, flight.command);
}

/// False while a study goes on, or after Ctrl-C: the flight may still be a good one.
bool is_over(const FlightEntry& flight) { return flight.figures || !flight.problem.empty(); }

}  // namespace

std::vector<const FlightEntry*> worst_flights(const Study& study, std::size_t most) {
  std::vector<const FlightEntry*> flights;
  for (const FlightEntry& flight : study.flights) {
    if (is_over(flight)) flights.push_back(&flight);
  }
  std::ranges::stable_sort(flights, std::greater<>(), [](const FlightEntry* flight) { return badness(*flight); });
  flights.resize(std::min(flights.size(), most));
  return flights;
}

void print_worlds(std::ostream& out, const Study& study) {
  out << fmt::format("\n{:<26}{:>8}{:>10}{:>10}{:>10}{:>10}{:>10}{:>13}{:>12}\n", "share of the estimate [%]",
                     "flights", "median", "10th pct", "least", "frozen", "idle [s]", "waiting [s]", "collisions");
  for (std::size_t p = 0; p < study.planners.size(); ++p) {
    std::vector<double> shares;
    int flights = 0, frozen = 0, collisions = 0;
    double idle_s = 0.0, waiting_s = 0.0;
    for (const FlightEntry& flight : study.flights) {
      if (flight.planner != p || !flight.figures) continue;
      ++flights;
      frozen += flight.figures->frozen_uavs.value_or(0) > 0;
      idle_s += flight.figures->frozen_s.value_or(0.0);
      waiting_s += flight.figures->waited_s.value_or(0.0);
      collisions += flight.figures->collisions;
      if (flight.figures->attainable_percent) shares.push_back(*flight.figures->attainable_percent);
    }
    const Spread spread = spread_of(shares);
    out << fmt::format("  {:<24}{:>8}{:>10.1f}{:>10.1f}{:>10.1f}{:>10}{:>10.0f}{:>13.0f}{:>12}\n",
                       report::shortened(study.planners[p], kLongestPlanner), flights, spread.median,
                       tenth_percentile(shares), spread.min, frozen, idle_s, waiting_s, collisions);
  }
  out << "frozen: flights in which a UAV did almost no work for a minute although there was work for it\n"
         "idle: time of all UAVs without work, less excused waiting; waiting: for others, as planners report it\n\n"
         "the worst flights, and how to repeat them\n";
  for (const FlightEntry* flight : worst_flights(study, kWorst)) out << text_of(study, *flight);
}

bool print_requirements(std::ostream& out, const Study& study, const std::vector<Requirement>& requirements) {
  bool all_hold = true;
  for (const Requirement& requirement : requirements) {
    for (const FlightEntry& flight : study.flights) {
      if (!is_over(flight) || requirement.holds(flight.figures)) continue;
      if (all_hold) out << "\nrequirements not met:\n";
      all_hold = false;
      out << fmt::format("  {}: {} in {}, {}, seed {}\n    {}\n", requirement.text, requirement.seen(flight.figures),
                         study.scenarios[flight.scenario], study.planners[flight.planner], flight.seed, flight.command);
    }
  }
  return all_hold;
}

}  // namespace skein::cli
