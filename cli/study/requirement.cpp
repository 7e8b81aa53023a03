#include "cli/study/requirement.hpp"

#include <cmath>

#include "core/expressions/expression_parser.hpp"
#include "core/scenario/scenario.hpp"
#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"

namespace skein::cli {
namespace {

/// The figures of a flight, as signals for the parser. A figure has only one value, so parse_requirement() sets
/// `live_only`, which forbids operators that look at earlier values, such as gain().
const std::vector<SignalInfo>& figure_table() {
  static const std::vector<SignalInfo> table = [] {
    std::vector<SignalInfo> all;
    for (const StudyColumn& column : study_columns()) {
      all.push_back({.name = column.name, .arguments = {}, .unit = kPlainNumber, .is_live = true, .meaning = {}});
    }
    return all;
  }();
  return table;
}

/// The value of a figure; NaN if it is not known.
double figure_of(const SignalUse& use, const std::optional<FlightFigures>& flight) {
  const auto value = flight ? study_column(std::string(use.info->name)).value(*flight) : std::nullopt;
  return value.value_or(std::nan(""));
}

}  // namespace

bool Requirement::holds(const std::optional<FlightFigures>& flight) const {
  std::vector<double> values;
  for (const SignalUse& use : figures) values.push_back(figure_of(use, flight));
  return margin_at(condition, {values, values, values}).holds;
}

std::string Requirement::seen(const std::optional<FlightFigures>& flight) const {
  std::vector<std::string> all;
  for (const SignalUse& use : figures) {
    const double value = figure_of(use, flight);
    const std::string name = figures.size() > 1 ? std::string(use.info->name) + " " : "";
    all.push_back(name + (std::isnan(value) ? "no figure" : fixed_at_most(value, 3)));
  }
  return joined(all, " and ");
}

Requirement parse_requirement(const std::string& text) try {
  static const SignalNames no_names{Scenario{}};
  Requirement requirement{text};
  requirement.condition =
      parse_condition(text, {.names = no_names, .live_only = true, .signals = &figure_table(), .signal_word = "figure"},
                      requirement.figures);
  return requirement;
} catch (const ExpressionError& error) {
  throw InputError("--require " + text + ": " + error.what());
}

}  // namespace skein::cli
