// Properties of the boxes, known before any structure has been seen.
// Frame W.   Units: metres.   Pure.
#pragma once

#include <optional>
#include <vector>

#include "core/types.hpp"

namespace skein::agent {

/// Whether a box is so large (45 m by 45 m, 20 m high) that it probably holds a whole site, and flights along its faces
/// would be useless.
bool is_site_box(const OrientedBox& box);

/// z in W of the highest point of all boxes, at least 0; 0 without boxes.
double top_of(const std::vector<OrientedBox>& boxes);

/// A place within this distance of a UAV's start counts as the start. Chosen.
inline constexpr double kBesideStartM = 1.0;

/// Whether p is straight above a UAV's start, within kBesideStartM.
bool is_above_start(const Vector3d& p_W, const Vector3d& start_W);

/// Height (z in W) at which a UAV that climbs straight up from p_W has left the box that contains p_W, and all further
/// boxes that it enters on its way.
/// @param margin_m  least distance to a box outside.   @returns nullopt if p_W is in no box.
std::optional<double> way_out_m(const std::vector<OrientedBox>& boxes, const Vector3d& p_W, double margin_m);

}  // namespace skein::agent
