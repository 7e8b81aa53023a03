// `skein bench --sensing`: what an explorer knows of the space around it, and what it costs to have all beams: the
// tables and pictures of docs/sensing.md.
#pragma once

#include "cli/console.hpp"
#include "cli/options.hpp"

namespace skein::cli {

/// Flies one explorer over each vendor, with beams and without, then bench_sensing, and prints its tables. With --write
/// pictures and tables go into that folder (bench/sensing/main.cpp). Takes some minutes, with --quick below one.
/// @returns kExitDone; kExitProcessFailed when a flight failed; kExitInterrupted. @throws InputError before it begins.
int bench_sensing(const BenchOptions& options, const Console& console);

}  // namespace skein::cli
