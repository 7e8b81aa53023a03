// The targets of `skein bench`, and whether a report meets them. Pure; a value that a report lacks counts as not
// measured.
#pragma once

#include "results/result.hpp"

namespace skein::cli {

/// Compares the values in `report` (speed, rounds, scale, relay, load, memory) with the targets: name, kind (at_least
/// or at_most), target, unit, value, met (null: not measured) and factor: how many times as good as the target, below 1
/// when missed.
Json targets_of(const Json& report);

}  // namespace skein::cli
