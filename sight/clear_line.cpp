#include "sight/clear_line.hpp"

#include <algorithm>

namespace skein::sim {
namespace {

/// Range of a query beyond the clearance, and so the longest step [m]. Queries of longer range cost more.
constexpr double kFarQuery = 1.5;

}  // namespace

bool is_clear_line(const RayScene& world, const Vector3d& a_W, const Vector3d& b_W, double clearance,
                   double tolerance) {
  const Vector3d step = b_W - a_W;
  const double length = step.norm();
  if (length > 0.0 && world.first_hit_distance(a_W, b_W, {.ground = false, .uavs = false})) return false;  // cheap
  for (double s = 0.0;;) {
    const Vector3d p_W = length > 0.0 ? Vector3d(a_W + s / length * step) : a_W;
    const double room = std::min(world.clearance(p_W, clearance + kFarQuery), clearance + kFarQuery) - clearance;
    if (room < -tolerance) return false;
    if (s >= length) return true;
    s = std::min(length, s + std::max(room, tolerance));
  }
}

}  // namespace skein::sim
