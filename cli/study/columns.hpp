// The figures by which a study compares flights: the columns of its tables, in order. Pure; any thread.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/study/figures.hpp"

namespace skein::cli {

struct StudyColumn {
  std::string name;   ///< in CSV files
  std::string title;  ///< in the report, with its unit
  std::string help;   ///< what it means, in a sentence
  int digits = 0;     ///< decimal places in the report
  bool in_report = true;
  std::function<std::optional<double>(const FlightFigures&)> value;
  bool paired = false;  ///< other_pairs() compares planners by it (pairs.hpp)
};

const std::vector<StudyColumn>& study_columns();
/// The column of this name. @throws std::out_of_range if there is none.
const StudyColumn& study_column(const std::string& name);

/// The values of this figure in those `flights` (of one planner in one scene) that have it.
std::vector<double> column_values(const StudyColumn& column, const std::vector<const FlightEntry*>& flights);

}  // namespace skein::cli
