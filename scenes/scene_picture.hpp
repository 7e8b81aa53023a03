// Draws a scene: the structure (with hidden surfaces removed), the boxes, the UAVs' starts, and the station.
// Frame W; metres.   Pure.
#pragma once

#include <string>

#include "core/scenario/scenario.hpp"
#include "core/scenario/scene.hpp"

namespace skein::sim {

/// @returns the text of an SVG file with two views side by side: from the south-south-east, and from above.
std::string scene_picture(const Scenario& scenario, const Scene& scene);

}  // namespace skein::sim
