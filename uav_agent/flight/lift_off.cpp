#include "uav_agent/flight/lift_off.hpp"

#include <algorithm>

#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/flight/site.hpp"

namespace skein::agent {
namespace {

constexpr double kLowSiteM = 40.0;                        ///< a site no higher than this is seen from above first
constexpr double kLowestHeightM = 3.0;                    ///< of the last one in the fleet
constexpr double kClimbLayerM = 2.0;                      ///< between the heights to which two UAVs climb
constexpr double kRoomyAsideM = 4.0, kRoomyAboveM = 4.0;  ///< where starts are in a box, and how far above it is out
constexpr double kStandingM = 2.0;                        ///< so high up there is room where somebody was set down
constexpr int kRoofRays = 4, kBoxRays = 8;                ///< that find a roof, and the structure that is in a box
constexpr double kStepM = 0.5;
constexpr double kBesideHeightM = 0.6;                   ///< so low, what is near stands beside the start
constexpr double kEvenM = 0.3, kLeastBesideWallM = 0.4;  ///< a wall on the map is as even as its cells are

/// Who was set down beside a wall needs no more room than that to rise along it.
double column_m(double wanted_m, const OccupancyMap& map, const Vector3d& from_W, double ground_m) {
  const Vector3d low_W(from_W.x(), from_W.y(), ground_m + kBesideHeightM);
  const auto beside_m = map.distance_to_occupied(low_W, wanted_m);
  return beside_m ? std::min(wanted_m, std::max(*beside_m - kEvenM, kLeastBesideWallM)) : wanted_m;
}

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
    const bool under = !agent.first_explorer() && box.contains(beside, 1.0) && bottom > p_WB.z();
    if (under) height = std::min(height, std::max(below, p_WB.z() + kLowestHeightM));
    // Inside a roomy one nothing is known of the space around; above it there is nothing.
    const bool inside = is_roomy(box) && !under && box.contains(beside, kRoomyAsideM);
    if (inside) height = std::max(height, 2.0 * box.center.z() - bottom + kRoomyAboveM + layer);
  }
  return std::max(height, p_WB.z());
}

double open_height_m(const AgentConfig& agent, const std::vector<OrientedBox>& boxes, const OccupancyMap& map,
                     const Vector3d& from_W, double ground_m, double roof_m, double wanted_m, double room_m) {
  double clearance_m = agent.me().body_radius_m + room_m;
  if (room_m <= kColumnM) clearance_m = column_m(clearance_m, map, from_W, ground_m);
  FreeSpace::Config column{.clearance_m = clearance_m, .floor_m = 0.0, .rays = kBoxRays};
  column.jut_m = column.clearance_m;
  const FreeSpace in_boxes(column, boxes, map);
  column.rays = kRoofRays;
  column.blind_height_m = roof_m;
  const FreeSpace below_roofs(column, boxes, map);
  double open_m = from_W.z();
  while (open_m < wanted_m) {
    const Vector3d p_W(from_W.x(), from_W.y(), std::min(wanted_m, open_m + kStepM));
    const bool standing = p_W.z() < ground_m + kStandingM;
    if (!standing && !(in_boxes.free(p_W) && below_roofs.free(p_W))) break;
    open_m = p_W.z();
  }
  return open_m;
}

}  // namespace skein::agent
