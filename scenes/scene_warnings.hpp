// Warnings about a scene that is valid but unusual. Frame W; metres.
#pragma once

#include <string>
#include <vector>

#include "core/scenario/scene.hpp"

namespace skein::sim {

/// Warns about interest points that lie outside all boxes: UAVs receive only the boxes, so nothing tells them where
/// such points are. The warning states how many there are, and the index and position of the first one. Pure.
/// @returns one sentence for the log and for `warnings` in result.json; empty if every point lies in a box.
std::vector<std::string> scene_warnings(const Scene& scene);

}  // namespace skein::sim
