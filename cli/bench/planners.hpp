// `skein bench --planners`: every planner flies a fixed set of scenes; its scores are shown beside those of a table.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/bench/bench_options.hpp"
#include "cli/console.hpp"
#include "cli/study/figures.hpp"
#include "cli/study/plan.hpp"

namespace skein::cli {

/// The planners whose scores are compared, as `skein compare --planners` takes them.
inline constexpr const char* kBenchPlanners = "flock,patrol,kios,xxh,star";
/// The scenes that benchmarks of planners fly: those of a contest; with --quick only towers of the procedural ones.
std::vector<std::string> bench_scenarios(const BenchOptions& options);

/// Flies a study of a benchmark. @returns nullopt after Ctrl-C.
std::optional<Study> flown_study(const StudyPlan& plan, const Console& console);

/// Flies the flights that these programs have not flown yet, in runs/bench-planners; prints the comparison, and writes
/// the table to --write. Takes about ten minutes, with --quick one.
/// @returns kExitDone; kExitProcessFailed when a flight failed; kExitInterrupted.
/// @throws InputError when the table cannot be read.
int bench_planners(const BenchOptions& options, const Console& console);

}  // namespace skein::cli
