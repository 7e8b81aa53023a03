// The cache of interest points of procedural scenes: sampling them takes a tenth of a second or more, and each run
// needs them three times (for the check before the run, the flight and the estimate). One file per scene, named by a
// hash of everything that the points depend on. If a file cannot be read or written, this costs time, but the result is
// the same. Several programs may share a cache.   Threads: any.
#pragma once

#include <filesystem>

#include "scenes/surface_sampling.hpp"

namespace skein::sim {

/// As sampled(), but uses the points in the folder `cache` if they are there; else samples them and writes them there.
Scene sampled_or_kept(UnsampledScene unsampled, const std::filesystem::path& cache);

}  // namespace skein::sim
