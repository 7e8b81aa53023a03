// Which figures of a flight are compared, in the order of the tables. Pure; any thread.
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
  int digits = 0;     ///< behind the point, in the report
  bool in_report = true;
  std::function<std::optional<double>(const FlightFigures&)> value;
  bool paired = false;  ///< pairs.csv compares planners by it, beside the score (pairs.hpp)
};

const std::vector<StudyColumn>& study_columns();
/// The one of this name. @throws std::out_of_range when there is none.
const StudyColumn& study_column(const std::string& name);

/// Of the flights of one cell that have this figure.
std::vector<double> column_values(const StudyColumn& column, const std::vector<const FlightEntry*>& flights);

}  // namespace skein::cli
