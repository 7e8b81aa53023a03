// Two finished runs on one page, with a common clock. The feed has the second run inside the first: its scene under the
// key "other", its lines as {"k": "other", "line": ...} (web/src/flights.js).   Any thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "view/feed.hpp"

namespace skein::view {

/// The time at which two runs begin to differ.
struct Parting {
  std::optional<double> time_s;     ///< none: they do not differ, or it is not known
  std::vector<std::string> fields;  ///< the values that differ first: "changi position"
  std::string unknown;              ///< why it is not known; empty: it is known
};

/// Fills a feed with both runs.
/// @throws InputError when a folder has no result, or when the scenes differ, so that points cannot be compared.
void tell_two_runs(const std::filesystem::path& a, const std::filesystem::path& b, const Parting& parting, Feed& feed);

}  // namespace skein::view
