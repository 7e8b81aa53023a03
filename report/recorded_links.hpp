// Reconstructs the radio links of a finished run for its page, from the open links in events.csv and the faults and
// collisions in result.json. These files do not say whether a link under a fault would be open without the fault: it
// counts as cut.   Pure; any thread.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "results/run_record.hpp"

namespace skein::report {

/// cut: by a fault; dead: one of its UAVs has collided; blocked: not open for any other reason.
enum class LinkState : std::uint8_t { blocked, linked, cut, dead };

/// A row-major square matrix: a row for each sender, a column for each receiver; node 0, the station, comes first.
using LinkStates = std::vector<LinkState>;

/// The states as a string of digits, in the same order.
std::string digits_of(const LinkStates& row_major);

/// The states of all links, each valid from its time on [s], ascending; empty if the run has no events about links.
std::vector<std::pair<double, LinkStates>> recorded_links(const results::RunRecord& run);

/// Whether a fault of this run cut links, so that the difference between `cut` and `blocked` is a guess.
bool has_cuts(const results::RunRecord& run);

}  // namespace skein::report
