// The report of a study as one HTML page: ranking, tables, plots and drawings of the best flights, links to the pages
// of its flights. It asks for nothing from elsewhere, and its links are relative: the folder can be moved. Pure; any
// thread.
#pragma once

#include <string>
#include <vector>

#include "cli/study/drawings.hpp"

namespace skein::cli {

/// All that the page and the files beside it show.
struct StudyReport {
  /// @param study  must live as long as this.
  StudyReport(const Study& study, StudyPictures pictures);

  const Study& study;
  StudyPictures pictures;
  std::vector<std::string> titles;  ///< of the scenes
  std::vector<PlannerPair> pairs;
  std::vector<StudyFigure> figures;
};

/// Where the figures and the LaTeX table are, from the study's folder.
inline constexpr const char* kFiguresFolder = "figures";
inline constexpr const char* kTexTable = "table.tex";

std::string study_page(const StudyReport& report);

}  // namespace skein::cli
