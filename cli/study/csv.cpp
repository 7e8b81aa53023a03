#include "cli/study/csv.hpp"

#include <spdlog/fmt/fmt.h>

#include "cli/study/columns.hpp"
#include "report/html.hpp"

namespace skein::cli {
namespace {

std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

/// Decimal places in files: enough to distinguish any two flights.
constexpr int kDigits = 4;

/// Whole numbers have no decimal places; empty if not known.
std::string number(const std::optional<double>& value) { return value ? fixed_at_most(*value, kDigits) : ""; }

std::string number_of_any(const std::vector<double>& values, double value) {
  return values.empty() ? "" : number(value);
}

}  // namespace

std::string flights_csv(const Study& study) {
  std::string csv = "scenario,planner,seed,status";
  for (const StudyColumn& column : study_columns()) csv += "," + column.name;
  csv += ",points_total,digest,problem,folder\n";
  for (const FlightEntry& flight : study.flights) {
    const FlightFigures none, &figures = flight.figures ? *flight.figures : none;
    csv += cell(study.scenarios[flight.scenario]) + "," + cell(study.planners[flight.planner]) + "," +
           std::to_string(flight.seed) + "," + figures.status;
    for (const StudyColumn& column : study_columns()) {
      csv += "," + (flight.figures ? number(column.value(figures)) : "");
    }
    csv += "," + (flight.figures ? std::to_string(figures.points_total) : "") + "," + figures.digest + "," +
           cell(flight.problem) + "," + cell(flight.folder) + "\n";
  }
  return csv;
}

std::string pairs_csv(const Study& study, const std::vector<PlannerPair>& pairs) {
  std::string csv = "figure,scenario,first,second,pairs,median,low,high,p,p_holm\n";
  for (const PlannerPair& pair : pairs) {
    using Value = std::optional<double>;
    csv += pair.figure + "," + (pair.scenario ? cell(study.scenarios[*pair.scenario]) : "") + "," +
           cell(study.planners[pair.first]) + "," + cell(study.planners[pair.second]) + "," +
           std::to_string(pair.differences.size()) + "," + number(pair.median) + "," +
           number(pair.interval ? Value(pair.interval->low) : std::nullopt) + "," +
           number(pair.interval ? Value(pair.interval->high) : std::nullopt) + "," +
           (pair.test ? fmt::format("{:.4g},{:.4g}", pair.test->p, *pair.p_holm) : ",") + "\n";
  }
  return csv;
}

std::string summary_csv(const Study& study) {
  std::string csv = "scenario,planner,flights";
  for (const StudyColumn& column : study_columns()) {
    for (const char* what : {"median", "min", "max"}) csv += "," + column.name + "_" + what;
  }
  csv += "\n";
  for (std::size_t s = 0; s < study.scenarios.size(); ++s) {
    for (std::size_t p = 0; p < study.planners.size(); ++p) {
      const auto entries = study.cell(p, s);
      csv += cell(study.scenarios[s]) + "," + cell(study.planners[p]) + "," + std::to_string(entries.size());
      for (const StudyColumn& column : study_columns()) {
        const std::vector<double> values = column_values(column, entries);
        const Spread spread = spread_of(values);
        for (const double value : {spread.median, spread.min, spread.max}) {
          csv += "," + number_of_any(values, value);
        }
      }
      csv += "\n";
    }
  }
  return csv;
}

std::string totals_csv(const Study& study) {
  std::string csv = "place,planner,ranked_by";
  for (const std::uint64_t seed : study.seeds) csv += ",test_" + std::to_string(seed);
  csv += ",max,median,worst\n";
  for (const Standing& standing : standings(study)) {
    csv += (standing.decides ? std::to_string(standing.place) : "") + "," + cell(study.planners[standing.planner]) +
           "," + rank_name(study.rank);
    for (const std::optional<double>& total : standing.totals) csv += "," + number(total);
    const std::vector<double> totals = complete_totals(standing);
    const Spread spread = spread_of(totals);
    for (const double value : {spread.max, spread.median, spread.min}) {
      csv += "," + number_of_any(totals, value);
    }
    csv += "\n";
  }
  return csv;
}

}  // namespace skein::cli
