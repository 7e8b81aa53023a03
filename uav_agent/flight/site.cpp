#include "uav_agent/flight/site.hpp"

#include <algorithm>

namespace skein::agent {
namespace {

constexpr double kRoomyM = 45.0, kRoomyHeightM = 20.0;  ///< least horizontal size and height

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

}  // namespace skein::agent
