// Scenarios that are drawn whole (core/scenario/drawn_worlds.hpp): drawn once, and kept as files in the user's cache.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace skein::cli {

/// What programs are to read for a scenario: the file in which a drawn world is kept, which is drawn now unless it was
/// before; any other scenario as it is named.
/// @throws InputError when the world cannot be kept; std::runtime_error when it cannot be drawn; Interrupted.
std::string scenario_source(const std::string& scenario, const std::optional<std::uint64_t>& scene_seed);

}  // namespace skein::cli
