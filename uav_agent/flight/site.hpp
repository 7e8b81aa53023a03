// Properties of the boxes, known before any structure has been seen.
// Frame W.   Units: metres.   Pure.
#pragma once

#include <vector>

#include "core/types.hpp"

namespace skein::agent {

/// Whether a box is so large (45 m by 45 m, 20 m high) that it probably holds a whole site, and flights along its faces
/// would be useless.
bool is_site_box(const OrientedBox& box);

/// z in W of the highest point of all boxes, at least 0; 0 without boxes.
double top_of(const std::vector<OrientedBox>& boxes);

}  // namespace skein::agent
