#include "uav_agent/maps/repeated_scans.hpp"

#include <cmath>

namespace skein::agent {

RepeatedScans::Repeated RepeatedScans::ask(const Isometry3d& X_WL) {
  const Quaterniond R_WL(X_WL.linear());
  const double alike = std::cos(0.5 * kTurnRad);  // q1.dot(q2) is the cosine of half the angle between them
  const std::pair<Quaterniond, Vector3d>* nearest = nullptr;
  double nearest_m = 0.0;
  for (const auto& scan : scans_) {
    if (std::abs(scan.first.dot(R_WL)) < alike) continue;
    const double distance_m = (scan.second - X_WL.translation()).norm();
    if (nearest == nullptr || distance_m < nearest_m) {
      nearest = &scan;
      nearest_m = distance_m;
    }
  }
  Repeated repeated;
  if (nearest != nullptr) {
    if (nearest_m < kNearM) {
      repeated.all = true;
      return repeated;
    }
    repeated.about_W = (nearest->second - X_WL.translation()) / nearest_m;
    repeated.cosine = std::cos(std::asin(member_width_m_ / nearest_m) + half_rad_);
  }
  scans_.emplace_back(R_WL, X_WL.translation());
  return repeated;
}

}  // namespace skein::agent
