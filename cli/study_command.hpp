// `skein contest` and `skein compare`: fly a study and write its report.
#pragma once

#include "cli/console.hpp"
#include "cli/study/figures.hpp"
#include "cli/study/flights.hpp"

namespace skein::cli {

/// Flies what has not been flown yet, then writes report.html, flights.csv, summary.csv, pairs.csv, table.tex,
/// figures/*.svg and, of a contest, totals.csv; also after Ctrl-C and with flights that failed.
/// @returns the exit code: kExitProcessFailed when a flight failed, kExitCheckFailed when one does not keep a
///   requirement. @throws InputError before anything flies;
///   Interrupted while the input is checked.
int run_study(const StudyOptions& options, const Console& console);

/// The figures of what was flown.
Study study_of(const StudyPlan& plan, StudyOutcomes outcomes);

/// The ranking of a contest, then median scores by scene and planner.
void print_study(std::ostream& out, const Study& study);

}  // namespace skein::cli
