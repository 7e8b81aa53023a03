#include "uav_agent/flight/site.hpp"

#include <algorithm>

#include "uav_agent/flight/lift_off.hpp"

namespace skein::agent {
namespace {

constexpr double kMinClearanceM = 1.8;
constexpr double kRoomyM = 45.0, kRoomyHeightM = 20.0;  ///< at least, of a box that says little
constexpr double kBlindFloorRatio = 0.25;               ///< of the highest box

}  // namespace

bool is_roomy(const OrientedBox& box) {
  return std::min(box.size.x(), box.size.y()) >= kRoomyM && box.size.z() >= kRoomyHeightM;
}

double top_of(const std::vector<OrientedBox>& boxes) {
  double top = 0.0;
  for (const OrientedBox& box : boxes) {
    top = std::max(top, box.center.z() + (box.R_WO.cwiseAbs() * (0.5 * box.size)).z());
  }
  return top;
}

Site site_of(const AgentConfig& agent, const std::vector<OrientedBox>& boxes, double blind_height_ratio) {
  Site site;
  site.top_m = top_of(boxes);
  site.roomy = std::ranges::any_of(boxes, is_roomy);
  site.blind_fleet = agent.blind_fleet();
  if (site.blind_fleet) {
    site.lowest_m = kBlindFloorRatio * site.top_m;
  } else {
    site.blind_height_m = blind_height_m(boxes, blind_height_ratio);
  }
  return site;
}

double centre_clearance_m(const AgentConfig& agent, double clearance_m) {
  return std::max(kMinClearanceM, agent.me().body_radius_m + clearance_m);
}

}  // namespace skein::agent
