#include "scenes/scene_warnings.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cstddef>

namespace skein::sim {
namespace {

/// Tolerance [m]: points are in single precision, and authors often fit boxes to the points without a margin.
constexpr double kMargin = 0.01;

}  // namespace

std::vector<std::string> scene_warnings(const Scene& scene) {
  std::size_t outside = 0, first = 0;
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    const Vector3d p_W = scene.points[i].p_W.cast<double>();
    const bool inside = std::any_of(scene.boxes.begin(), scene.boxes.end(),
                                    [&](const OrientedBox& box) { return box.contains(p_W, kMargin); });
    if (!inside && outside++ == 0) first = i;
  }
  if (outside == 0) return {};
  const Eigen::Vector3f& p = scene.points[first].p_W;
  return {
      fmt::format("{} of {} interest points lie outside every box, the first is point {} at ({:.2f}, {:.2f}, {:.2f})",
                  outside, scene.points.size(), first, p.x(), p.y(), p.z())};
}

}  // namespace skein::sim
