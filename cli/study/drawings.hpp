// The drawings of a study, used on its page and as files. Panels of one quantity have the same axis. Pure; any thread.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "cli/study/pairs.hpp"
#include "cli/study/plots.hpp"
#include "report/flight_picture.hpp"

namespace skein::cli {

/// Drawings of the best flights, by indices of scenario and planner.
using StudyPictures = std::map<std::pair<std::size_t, std::size_t>, report::FlightPicture>;

enum class FigureKind { total, score, curves, difference, flight };

struct StudyFigure {
  FigureKind kind = FigureKind::score;
  std::optional<std::size_t> scenario;  ///< nullopt: all scenarios
  std::string file;                     ///< "score-towers.svg"
  std::string caption, small;
  std::string svg;
  std::string page = {};                 ///< report of the flight that it shows, as FlightEntry::page
  std::vector<LegendEntry> legend = {};  ///< for the file; the page has its own
};

/// All figures, in the order of the page. @param titles  titles of the scenes.
std::vector<StudyFigure> study_figures(const Study& study, const StudyPictures& pictures,
                                       const std::vector<PlannerPair>& pairs, const std::vector<std::string>& titles);

/// Axis from 0 to a round number that is not below any score of the study.
report::Axis score_axis(const Study& study);

}  // namespace skein::cli
