// A layout for Foxglove and related viewers: it shows what is worth viewing first in a recording. Pure.
#pragma once

#include "core/scenario/scenario.hpp"
#include "process/json_text.hpp"

namespace skein::cli {

/// The fleet in 3D, the score and each UAV's speed over time, and a table of events.
Json viewer_layout(const Scenario& scenario);

}  // namespace skein::cli
