// What every flight of a study must keep: `collisions==0`, `attainable_percent>=5`. Names are those of study_columns().
// Pure.
#pragma once

#include <optional>
#include <string>

#include "cli/study/columns.hpp"

namespace skein::cli {

struct Requirement {
  enum class Relation { equal, unequal, less, at_most, more, at_least };

  std::string text;  ///< as it was written
  const StudyColumn* column = nullptr;
  Relation relation = Relation::equal;
  double value = 0.0;

  /// What a flight without this figure, or without any, does not keep.
  bool holds(const std::optional<FlightFigures>& figures) const;
};

/// @throws InputError for anything but NAME RELATION NUMBER; it lists the names.
Requirement parse_requirement(const std::string& text);

}  // namespace skein::cli
