// A layout for viewers of Foxglove's family: what of a recording is worth looking at first. Pure.
#pragma once

#include "core/scenario.hpp"
#include "process/json_text.hpp"

namespace skein::cli {

/// The fleet in 3D, the score and each UAV's speed over time, and what happened as a table.
Json viewer_layout(const Scenario& scenario);

}  // namespace skein::cli
