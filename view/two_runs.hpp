// Two finished runs on one page and one clock. The second is told within the first: its scene under "other", its lines
// as {"k": "other", "line": ...} (web/src/flights.js).   Any thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "view/feed.hpp"

namespace skein::view {

/// Where two runs part.
struct Parting {
  std::optional<double> time_s;     ///< none: nowhere, or not known
  std::vector<std::string> fields;  ///< "changi position"
  std::string unknown;              ///< why it is not known; empty: it is
};

/// Fills a feed with both.
/// @throws InputError when a folder holds no result, or their scenes differ: then they have no points in common.
void tell_two_runs(const std::filesystem::path& a, const std::filesystem::path& b, const Parting& parting, Feed& feed);

}  // namespace skein::view
