// The radio links of a finished run, as its page shows them: from events.csv, which has links that work, and from the
// faults of its result. What a recording does not tell is whether a link that a fault covers would have been there
// otherwise: it counts as cut.   Pure; any thread.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "results/run_data.hpp"

namespace skein::report {

enum class LinkState : std::uint8_t { blocked, linked, cut, dead };

/// Row by sender, node 0 (the station) first.
using LinkStates = std::vector<LinkState>;

/// A digit for each.
std::string digits_of(const LinkStates& row_major);

/// From each of these times on [s], ascending; empty where the recording has no links.
std::vector<std::pair<double, LinkStates>> recorded_links(const results::RunData& run);

/// Whether a fault of this run cut links, so that they are told apart by guess.
bool has_cuts(const results::RunData& run);

}  // namespace skein::report
