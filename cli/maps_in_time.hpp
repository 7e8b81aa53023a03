// `skein replay --maps`: computes snapshots of UAVs' maps that a run did not keep, by flying its recording again.
#pragma once

#include <filesystem>

#include "cli/console.hpp"

namespace skein::cli {

/// Computes the map snapshots and moves them into the folder, if it has none or damaged ones. If the software's
/// messages now differ from the recorded ones, the maps are not those of this run: drops them with a warning.
/// @returns 0, also after such a warning; else the exit code of the flight, which has printed the reason.
/// @throws InputError when the snapshots are missing and cannot be computed.
int add_maps_in_time(const std::filesystem::path& run, const Console& console);

}  // namespace skein::cli
