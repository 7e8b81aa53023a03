// The kinds of the values in result.json, which pages and commands rely on.   Pure; any thread.
#pragma once

#include <string>

#include "process/json_text.hpp"

namespace skein::results {

/// The first mistake in a result that somebody edited, or that is none: its status is missing, or a value that readers
/// use is of another kind than docs/result.schema.json says. Any other key may be missing, since earlier versions wrote
/// fewer, and null means that nobody knows the value.
/// @returns the key and what is right: `uavs[0].distance_m: must be a number, not "12"`; empty: no mistake.
std::string wrong_key(const Json& result);

}  // namespace skein::results
