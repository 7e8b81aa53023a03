// What follows from the boxes before anything has been seen.
// Frame W.   Units: metres.   Pure.
#pragma once

#include <vector>

#include "core/types.hpp"

namespace skein::agent {

/// Whether a box is too large to be one piece of structure whose faces are worth flying.
bool is_roomy(const OrientedBox& box);

/// z of the highest point of all boxes, 0 without boxes.
double top_of(const std::vector<OrientedBox>& boxes);

}  // namespace skein::agent
