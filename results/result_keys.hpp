// The kinds of the values in result.json, which pages and commands rely on.   Pure; any thread.
#pragma once

#include <string>

#include "process/json_text.hpp"

namespace skein::results {

/// Finds the first mistake in the content of a result.json, for example after a user has edited it. Mistakes are a
/// missing status, and a value that readers use of another kind than docs/result.schema.json says. Other keys may be
/// missing, because earlier versions wrote fewer, and a value may be null, which means unknown.
/// @returns the key and what is right: `uavs[0].distance_m: must be a number, not "12"`; empty: no mistake.
std::string wrong_key(const Json& result);

}  // namespace skein::results
