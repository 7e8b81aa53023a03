// The sections of a study's page, as HTML. Pure; any thread.
#pragma once

#include <initializer_list>
#include <string>

#include "cli/study/page.hpp"

namespace skein::cli {

/// The ranking of a contest.
std::string ranking_section(const StudyReport& report);
/// Score, share and points of every planner in every scene.
std::string overview_section(const StudyReport& report);
/// Plots of scores (dots and boxes), then of scores over time.
std::string spread_section(const StudyReport& report);
/// Planners compared flight by flight, with intervals and tests.
std::string pairs_section(const StudyReport& report);
/// Times and shares of captures from picture to station, by planner.
std::string delivery_section(const StudyReport& report);
/// Everything about one scene: figures, flights, UAVs, drawings.
std::string scene_section(const StudyReport& report, std::size_t scenario);

/// A planner's name with its colour.
std::string planner_cell(const Study& study, std::size_t planner);
/// Figures of these kinds side by side. @param scenario  nullopt: figures that are about all scenes
std::string figure_panels(const StudyReport& report, std::initializer_list<FigureKind> kinds,
                          std::optional<std::size_t> scenario = {});

}  // namespace skein::cli
