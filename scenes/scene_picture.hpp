// A scene drawn: what stands there, with hidden surfaces hidden, the boxes, who starts where, and the station.
// Frame W; metres.   Pure.
#pragma once

#include <string>

#include "core/scenario.hpp"
#include "core/scene.hpp"

namespace skein::sim {

/// From the south-south-east and from above, side by side; an SVG file.
std::string scene_picture(const Scenario& scenario, const Scene& scene);

}  // namespace skein::sim
