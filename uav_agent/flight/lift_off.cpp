#include "uav_agent/flight/lift_off.hpp"

#include <algorithm>

#include "uav_agent/flight/site.hpp"

namespace skein::agent {
namespace {

constexpr double kLowSiteM = 40.0;                        ///< a site no higher than this is seen from above first
constexpr double kLowestHeightM = 3.0;                    ///< of the last one in the fleet
constexpr double kClimbLayerM = 2.0;                      ///< between the heights to which two UAVs climb
constexpr double kRoomyAsideM = 4.0, kRoomyAboveM = 4.0;  ///< where starts are in a box, and how far above it is out

}  // namespace

double blind_height_m(const std::vector<OrientedBox>& boxes, double ratio) {
  const double top = top_of(boxes);
  return (top < kLowSiteM ? 1.0 : ratio) * top;
}

double lift_off_height_m(const AgentConfig& agent, const std::vector<OrientedBox>& boxes, const Vector3d& p_WB,
                         double blind_m, double clearance_m) {
  const double layer = kClimbLayerM * static_cast<double>(agent.fleet.size() - 1 - agent.self);
  double height = kLowestHeightM + layer;
  if (!boxes.empty()) height = std::max(height, blind_m + 1.0 + layer);
  for (const OrientedBox& box : boxes) {
    const double bottom = box.center.z() - (box.R_WO.cwiseAbs() * (0.5 * box.size)).z();
    const double below = bottom - agent.me().body_radius_m - clearance_m;
    const Vector3d beside(p_WB.x(), p_WB.y(), box.center.z());
    const bool under = box.contains(beside, 1.0) && bottom > p_WB.z();
    if (under) height = std::min(height, std::max(below, p_WB.z() + kLowestHeightM));
    // Inside a roomy one nothing is known of the space around; above it there is nothing.
    const bool inside = is_roomy(box) && !under && box.contains(beside, kRoomyAsideM);
    if (inside) height = std::max(height, 2.0 * box.center.z() - bottom + kRoomyAboveM + layer);
  }
  return std::max(height, p_WB.z());
}

}  // namespace skein::agent
