#include "cli/study/conditions_table.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <optional>
#include <ostream>

#include "results/causes.hpp"

namespace skein::cli {
namespace {

constexpr const results::Cause& kTooPoor = results::kCauses[*results::cause_of("below_threshold")];

struct Row {
  int flights = 0, collisions = 0, by_battery = 0;
  std::vector<double> shares;  ///< of the estimate [%]
  double estimates = 0.0;      ///< sum, of flights whose losses are known
  std::map<std::string, double> losses, poor_parts;
  std::optional<double> median() const {
    return shares.empty() ? std::nullopt : std::optional(spread_of(shares).median);
  }
};

/// Adds the parts of the loss by pictures too poor to count. If figures do not split it, as those of earlier versions,
/// all of it is `unsplit`.
void add_poor_parts(const FlightFigures& figures, std::map<std::string, double>& sums) {
  for (const auto& [part, score] : figures.poor_parts) sums[part] += score;
  const auto all = figures.losses.find(kTooPoor.key);
  if (figures.poor_parts.empty() && all != figures.losses.end()) sums[results::kPoorParts.back().key] += all->second;
}

Row row_of(const Study& study, const std::string& conditions, std::size_t planner) {
  Row row;
  for (const FlightEntry& flight : study.flights) {
    const bool belongs = flight.planner == planner && study.scene_conditions.at(flight.scenario) == conditions;
    if (!belongs || !flight.figures) continue;
    ++row.flights;
    row.collisions += flight.figures->collisions;
    row.by_battery += flight.figures->collisions_by_battery;
    if (flight.figures->attainable_percent) row.shares.push_back(*flight.figures->attainable_percent);
    if (flight.figures->losses.empty()) continue;
    row.estimates += flight.figures->attainable.value_or(0.0);
    for (const auto& [cause, score] : flight.figures->losses) row.losses[cause] += score;
    add_poor_parts(*flight.figures, row.poor_parts);
  }
  return row;
}

/// By conditions and planner.
using Rows = std::map<std::pair<std::string, std::size_t>, Row>;

void print_losses(std::ostream& out, const Study& study, const std::vector<std::string>& all, const Rows& rows) {
  out << "\nLost, as a share of the estimate [%]:\n\n| conditions | planner |";
  for (const results::Cause& cause : results::kCauses) out << ' ' << cause.title << " |";
  for (const results::Cause& part : results::kPoorParts) out << ' ' << kTooPoor.title << ": " << part.title << " |";
  out << "\n|---|---|";
  for (std::size_t i = 0; i < results::kCauses.size() + results::kPoorParts.size(); ++i) out << "---|";
  out << '\n';
  for (const std::string& conditions : all) {
    for (std::size_t p = 0; p < study.planners.size(); ++p) {
      const Row& row = rows.at({conditions, p});
      out << fmt::format("| `{}` | `{}` |", conditions, study.planners[p]);
      const auto print_share = [&](const std::map<std::string, double>& losses, const results::Cause& cause) {
        const auto lost = losses.find(cause.key);
        const bool known = lost != losses.end() && row.estimates > 0.0;
        out << ' ' << (known ? fmt::format("{:.1f}", 100.0 * lost->second / row.estimates) : "-") << " |";
      };
      for (const results::Cause& cause : results::kCauses) print_share(row.losses, cause);
      for (const results::Cause& part : results::kPoorParts) print_share(row.poor_parts, part);
      out << '\n';
    }
  }
}

}  // namespace

void print_conditions(std::ostream& out, const Study& study) {
  std::vector<std::string> all;
  for (const std::string& conditions : study.scene_conditions) {
    if (std::ranges::find(all, conditions) == all.end()) all.push_back(conditions);
  }
  if (all.empty()) return;
  Rows rows;
  for (const std::string& conditions : all) {
    for (std::size_t p = 0; p < study.planners.size(); ++p) rows[{conditions, p}] = row_of(study, conditions, p);
  }
  out << "\n| conditions | planner | flights | share of the estimate [%], median | of " << all.front()
      << "'s [%] | collisions | of these with an empty battery |\n|---|---|---|---|---|---|---|\n";
  for (const std::string& conditions : all) {
    for (std::size_t p = 0; p < study.planners.size(); ++p) {
      const Row& row = rows.at({conditions, p});
      const auto median = row.median(), first = rows.at({all.front(), p}).median();
      const bool comparable = median && first && *first > 0.0;
      out << fmt::format("| `{}` | `{}` | {} | {} | {} | {} | {} |\n", conditions, study.planners[p], row.flights,
                         median ? fmt::format("{:.1f}", *median) : "-",
                         comparable ? fmt::format("{:.0f}", 100.0 * *median / *first) : "-", row.collisions,
                         row.by_battery);
    }
  }
  print_losses(out, study, all, rows);
}

}  // namespace skein::cli
