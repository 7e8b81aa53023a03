// What is strange about a scene, though nothing about it is wrong. Frame W; metres.
#pragma once

#include <string>
#include <vector>

#include "core/scene.hpp"

namespace skein::sim {

/// Interest points outside every box: UAVs are not told of where they are. One sentence with their number and the
/// first one. Pure.
/// @returns sentences for the log and for `warnings` in result.json; none when there is nothing to say.
std::vector<std::string> scene_warnings(const Scene& scene);

}  // namespace skein::sim
