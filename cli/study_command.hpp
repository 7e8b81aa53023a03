// What `skein contest` and `skein compare` gather and print of a study.
#pragma once

#include <ostream>

#include "cli/study/figures.hpp"
#include "cli/study/flights.hpp"

namespace skein::cli {

/// Gathers the figures of all flights, for the report.
Study study_of(const StudyPlan& plan, StudyOutcomes outcomes);

/// Prints the ranking of a contest, then median scores by scene and planner.
void print_study(std::ostream& out, const Study& study);

}  // namespace skein::cli
