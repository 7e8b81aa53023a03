// Flies a study as a sweep: plans it into a folder of units, lets an engine fly them, and merges the results.
#pragma once

#include "cli/console.hpp"
#include "cli/study/flights.hpp"

namespace skein::cli {

/// Lets the engine of the plan's options fly all flights that have no result yet. It can be interrupted at any moment;
/// the next call continues. Threads: one. @throws InputError if the engine is not installed, or rejects the units.
StudyOutcomes fly_sweep(const StudyPlan& plan, const Console& console);

/// Prints the state of a sweep: flights with results, units that its engine holds, and failed units with the last line
/// of their logs. @returns the outcomes so far. @throws InputError if there is no sweep.
StudyOutcomes tell_sweep(const StudyPlan& plan, const Console& console);

/// Changes to the working folder in which the user started the sweep of a study.
/// @returns the arguments of `skein` that continue it. @throws InputError if the study's folder holds no sweep.
std::vector<std::string> enter_sweep(const std::filesystem::path& study);

}  // namespace skein::cli
