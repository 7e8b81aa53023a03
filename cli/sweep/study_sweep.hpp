// A study as a sweep: planned once into a folder of units, flown by an engine, merged.
#pragma once

#include "cli/console.hpp"
#include "cli/study/flights.hpp"

namespace skein::cli {

/// Flies what has not been flown, by the engine that the plan's options name. Interrupted at any moment, it goes on
/// with the next call. From one thread. @throws InputError when there is no such engine, or it takes no units.
StudyOutcomes fly_sweep(const StudyPlan& plan, const Console& console);

/// Tells what is there of a sweep, what its engine holds, and what failed with its last words.
/// @returns what is there of its flights.
StudyOutcomes tell_sweep(const StudyPlan& plan, const Console& console);

/// The command of a sweep in a study's folder, from the working folder in which it was typed, where this goes, too.
/// @throws InputError when there is none.
std::vector<std::string> enter_sweep(const std::filesystem::path& study);

}  // namespace skein::cli
