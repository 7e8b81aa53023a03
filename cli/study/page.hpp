// The report of a study as one HTML page: ranking, tables, box plots and drawings of the best flights. It asks for
// nothing from elsewhere. Pure; any thread.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "cli/study/figures.hpp"
#include "cli/study/flight_picture.hpp"

namespace skein::cli {

/// Of the best flights, by scenario and planner.
using StudyPictures = std::map<std::pair<std::size_t, std::size_t>, FlightPicture>;

std::string study_page(const Study& study, const StudyPictures& pictures);

}  // namespace skein::cli
