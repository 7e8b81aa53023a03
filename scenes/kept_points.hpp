// Points of procedural scenes, kept from run to run: drawing them takes a tenth of a second and more, and each run
// needs them three times (the check before it, the flight, the estimate). A file each, named by a hash of all that they
// depend on. A cache that cannot be read or written costs time, never a result. Several programs may share one.
#pragma once

#include <filesystem>

#include "scenes/surface_sampling.hpp"

namespace skein::sim {

/// As sampled(); from the folder where they lie there, else drawn and kept.
Scene sampled_or_kept(UnsampledScene unsampled, const std::filesystem::path& cache);

}  // namespace skein::sim
