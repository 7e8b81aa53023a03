// The report of a study as one HTML page: ranking, tables, plots, drawings of the best flights, and links to reports
// of its flights. It loads nothing from the network, and its links are relative, so the folder can be moved. Pure; any
// thread.
#pragma once

#include <string>
#include <vector>

#include "cli/study/drawings.hpp"

namespace skein::cli {

/// Everything that the page and the files beside it show.
struct StudyReport {
  /// @param study  must live as long as this.
  StudyReport(const Study& study, StudyPictures pictures);

  const Study& study;
  StudyPictures pictures;
  std::vector<std::string> titles;  ///< of the scenes
  std::vector<PlannerPair> pairs;
  std::vector<StudyFigure> figures;
};

/// Folder of the figures, and file of the LaTeX table, relative to the study's folder.
inline constexpr const char* kFiguresFolder = "figures";
inline constexpr const char* kTexTable = "table.tex";

std::string study_page(const StudyReport& report);

}  // namespace skein::cli
