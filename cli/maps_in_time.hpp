// `skein replay --maps`: computes the snapshots of UAVs' maps that a run did not keep, by replaying its recording.
#pragma once

#include <filesystem>

#include "cli/console.hpp"

namespace skein::cli {

/// If the run's folder has no map snapshots, or damaged ones, computes them and moves them there. If the software's
/// messages or the world now differ from the recorded ones, the maps are not those of this run: drops them with a
/// warning. @returns 0, also after such a warning; else the exit code of the flight, which has printed the reason.
/// @throws InputError when the snapshots are missing and cannot be computed.
int add_maps_in_time(const std::filesystem::path& run, const Console& console);

}  // namespace skein::cli
