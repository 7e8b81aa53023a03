// Requirements that every flight of a study must meet: `collisions==0`, `frozen_s <= 80 and score >= 100`. These are
// conditions as in properties (core/expressions/expression_parser.hpp), over the figures of study_columns(), without
// units. Pure.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/study/columns.hpp"
#include "core/expressions/expression.hpp"
#include "core/expressions/signal_table.hpp"

namespace skein::cli {

struct Requirement {
  std::string text;  ///< as the user wrote it
  Expression condition = {};
  std::vector<SignalUse> figures = {};  ///< by slot in the condition

  /// Whether a flight meets it; false if a figure that decides it, or all figures (nullopt), are not known.
  bool holds(const std::optional<FlightFigures>& flight) const;
  /// The figures of a flight that the requirement names, for people.
  std::string seen(const std::optional<FlightFigures>& flight) const;
};

/// @throws InputError unless `text` is a condition over figures; for an unknown name, the message suggests names.
Requirement parse_requirement(const std::string& text);

}  // namespace skein::cli
