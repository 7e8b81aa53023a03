#include "sight/body_spheres.hpp"

#include <algorithm>

namespace skein::sim {

void BodySpheres::set(UavIndex uav, const Vector3d& p_W, double radius_m) {
  blocks_.resize(std::max(blocks_.size(), uav / kLanes + 1));
  Block& block = blocks_[uav / kLanes];
  const auto lane = static_cast<Eigen::Index>(uav % kLanes);
  block.x[lane] = static_cast<float>(p_W.x());
  block.y[lane] = static_cast<float>(p_W.y());
  block.z[lane] = static_cast<float>(p_W.z());
  block.radius[lane] = static_cast<float>(radius_m);
}

void BodySpheres::about(const Vector3d& from_W, const Vector3d& to_W, double margin_m,
                        std::vector<UavIndex>& uavs) const {
  uavs.clear();
  const Eigen::Vector3f from = from_W.cast<float>(), way = (to_W - from_W).cast<float>();
  const float length2 = way.squaredNorm(), per_length2 = length2 > 0.0F ? 1.0F / length2 : 0.0F;
  // Includes a generous bound of the rounding errors.
  const auto slack = static_cast<float>(margin_m + 0.01 + 1e-5 * (from_W.norm() + to_W.norm()));
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const Block& block = blocks_[b];
    const Lanes dx = block.x - from.x(), dy = block.y - from.y(), dz = block.z - from.z();
    const Lanes along = (dx * way.x() + dy * way.y() + dz * way.z()) * per_length2;
    const Lanes share = along.max(0.0F).min(1.0F);
    const Lanes ex = dx - share * way.x(), ey = dy - share * way.y(), ez = dz - share * way.z();
    const Lanes beyond = ex * ex + ey * ey + ez * ez - (block.radius + slack).square();
    if (!(beyond.minCoeff() <= 0.0F)) continue;
    for (int lane = 0; lane < kLanes; ++lane) {
      if (beyond[lane] <= 0.0F) uavs.emplace_back(b * kLanes + static_cast<std::size_t>(lane));
    }
  }
}

}  // namespace skein::sim
