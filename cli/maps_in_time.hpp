// skein replay --maps: a run that did not keep its UAVs' maps in time is flown again from its recording to have them.
#pragma once

#include <filesystem>

#include "cli/console.hpp"

namespace skein::cli {

/// Where the folder has no maps in time, or damaged ones, they are computed and moved there. Those of software that
/// says something else than it said then are no maps of this run: they are dropped, with a warning.
/// @returns 0, also after such a warning; else the exit code of the flight, which has told why.
/// @throws InputError when they are not there and cannot be computed.
int add_maps_in_time(const std::filesystem::path& run, const Console& console);

}  // namespace skein::cli
