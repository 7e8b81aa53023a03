// `skein bench --sensing`: what an explorer knows of the space around it, and the cost of delivering all LiDAR
// beams: the tables and pictures of docs/sensing.md.
#pragma once

#include "cli/bench/bench_options.hpp"
#include "cli/console.hpp"

namespace skein::cli {

/// Flies one explorer over each DDS vendor, with and without beams, then runs bench_sensing and prints its tables.
/// --write names a folder for its pictures and tables (bench/sensing/main.cpp). Takes minutes, --quick less than one.
/// @returns kExitDone; kExitProcessFailed when a flight failed.
/// @throws InputError if a program is not built, before anything flies; Interrupted.
int bench_sensing(const BenchOptions& options, const Console& console);

}  // namespace skein::cli
