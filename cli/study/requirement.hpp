// Requirements that every flight of a study must meet: `collisions==0`, `attainable_percent>=5`. Names are those of
// study_columns(). Pure.
#pragma once

#include <optional>
#include <string>

#include "cli/study/columns.hpp"

namespace skein::cli {

struct Requirement {
  enum class Relation { equal, unequal, less, at_most, more, at_least };

  std::string text;  ///< as the user wrote it
  const StudyColumn* column = nullptr;
  Relation relation = Relation::equal;
  double value = 0.0;

  /// Whether a flight meets it; false if this figure, or all figures (nullopt), are not known.
  bool holds(const std::optional<FlightFigures>& figures) const;
};

/// @throws InputError unless `text` is NAME RELATION NUMBER; for an unknown name, the message suggests names.
Requirement parse_requirement(const std::string& text);

}  // namespace skein::cli
