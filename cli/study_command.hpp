// `skein contest` and `skein compare`, and what they gather and print of a study.
#pragma once

#include <ostream>

#include "cli/console.hpp"
#include "cli/study/figures.hpp"
#include "cli/study/flights.hpp"
#include "cli/study_options.hpp"

namespace skein::cli {

/// `skein contest` and `skein compare`: flies the flights that are still missing, then writes report.html, flights.csv,
/// summary.csv, pairs.csv, table.tex, figures/*.svg and, for a contest, totals.csv; also after Ctrl-C and when flights
/// have failed. @returns kExitProcessFailed when a flight failed, kExitCheckFailed when one does not meet a
///   requirement, kExitInterrupted after Ctrl-C. @throws InputError before anything flies; Interrupted while the input
///   is checked.
int run_study(const StudyOptions& options, const Console& console);

/// Gathers the figures of all flights, for the report.
Study study_of(const StudyPlan& plan, StudyOutcomes outcomes);

/// Prints the ranking of a contest, then median scores by scene and planner.
void print_study(std::ostream& out, const Study& study);

}  // namespace skein::cli
