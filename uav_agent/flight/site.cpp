#include "uav_agent/flight/site.hpp"

#include <algorithm>

namespace skein::agent {
namespace {

constexpr double kSiteM = 45.0, kSiteHeightM = 20.0;  ///< least horizontal size and height

}  // namespace

bool is_site_box(const OrientedBox& box) {
  return std::min(box.size.x(), box.size.y()) >= kSiteM && box.size.z() >= kSiteHeightM;
}

double top_of(const std::vector<OrientedBox>& boxes) {
  double top = 0.0;
  for (const OrientedBox& box : boxes) {
    top = std::max(top, box.center.z() + (box.R_WO.cwiseAbs() * (0.5 * box.size)).z());
  }
  return top;
}

}  // namespace skein::agent
