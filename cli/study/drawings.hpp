// The figures of a study: the same on its page and in files. Panels of one quantity have one axis. Pure; any thread.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "cli/study/pairs.hpp"
#include "cli/study/plots.hpp"
#include "report/flight_picture.hpp"

namespace skein::cli {

/// Of the best flights, by scenario and planner.
using StudyPictures = std::map<std::pair<std::size_t, std::size_t>, report::FlightPicture>;

enum class FigureKind { total, score, curves, difference, flight };

struct StudyFigure {
  FigureKind kind = FigureKind::score;
  std::optional<std::size_t> scenario;  ///< none: all of them
  std::string file;                     ///< "score-towers.svg"
  std::string caption, small;
  std::string svg;
  std::string page = {};                 ///< of the flight that it shows, as FlightEntry has it
  std::vector<LegendEntry> legend = {};  ///< for who sees the file alone
};

/// In the order in which the page has them. @param titles  of the scenes.
std::vector<StudyFigure> study_figures(const Study& study, const StudyPictures& pictures,
                                       const std::vector<PlannerPair>& pairs, const std::vector<std::string>& titles);

/// From 0 to a round number that no score of the study exceeds.
report::Axis score_axis(const Study& study);

}  // namespace skein::cli
