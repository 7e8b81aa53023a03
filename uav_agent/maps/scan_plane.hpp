// Where a key frame looked. Its rings lie within 15 degrees of a plane through the sensor that a servo turns, and the
// frame does not say which; its hits do, wherever they spread far enough around the sensor.
// Frame W.   Units: m.   Pure.
#pragma once

#include <optional>
#include <vector>

#include "core/types.hpp"

namespace skein::agent {

/// Sine of the angle to the plane up to which a frame is sure to have looked: what remains of its 15 degrees after the
/// error of the plane's own.
inline constexpr double kSurelyLookedSine = 0.156;

/// The plane's unit normal; nullopt where hits are too few, or lie so that more than one plane fits them.
std::optional<Vector3d> scan_plane(const Vector3d& p_WS, const std::vector<Eigen::Vector3f>& hits_W);

}  // namespace skein::agent
