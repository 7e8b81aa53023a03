#include "uav_agent/flight/site.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace skein::agent {
namespace {

constexpr double kOutM = 1e-3;  ///< against rounding: a place this far above a box's top is not in the box
constexpr double kSiteM = 45.0, kSiteHeightM = 20.0;  ///< least horizontal size and height; chosen

/// z in W at which a vertical line upwards from p, which is in the box, leaves it, if all its sides are moved outwards.
double leaves_box_m(const OrientedBox& box, const Vector3d& p_W, double margin_m) {
  const Vector3d p_O = box.R_WO.transpose() * (p_W - box.center), up_O = box.R_WO.row(2);
  double way_m = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (up_O[axis] == 0.0) continue;
    const double side_m = std::copysign(0.5 * box.size[axis] + margin_m, up_O[axis]);
    way_m = std::min(way_m, (side_m - p_O[axis]) / up_O[axis]);
  }
  return p_W.z() + way_m;
}

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

bool is_above_start(const Vector3d& p_W, const Vector3d& start_W) {
  return (p_W - start_W).head<2>().norm() < kBesideStartM;
}

std::optional<double> way_out_m(const std::vector<OrientedBox>& boxes, const Vector3d& p_W, double margin_m) {
  std::optional<double> out_m;
  Vector3d at_W = p_W;
  for (bool in_box = true; in_box;) {
    in_box = false;
    for (const OrientedBox& box : boxes) {
      if (!box.contains(at_W, out_m ? margin_m : 0.0)) continue;
      at_W.z() = leaves_box_m(box, at_W, margin_m) + kOutM;
      out_m = at_W.z();
      in_box = true;
    }
  }
  return out_m;
}

}  // namespace skein::agent
