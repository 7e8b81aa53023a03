#include "sim_server/scenes/variation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <tuple>

#include "core/euler.hpp"
#include "core/random_stream.hpp"

namespace skein::sim {
namespace {

constexpr double kSingleBox = 0.25, kMerge = 0.3, kSplit = 0.3;  ///< shares of the seeds
constexpr double kLargestTurn = 0.12;                            ///< of a box's axes [rad]
constexpr double kLargestSwing = 2.0;   ///< how far a turn may move the ends of a box: long boxes turn less
constexpr double kLargestMargin = 1.0;  ///< that is added to the family's own
constexpr double kLongBox = 30.0;       ///< that may be split

/// The smallest box with the given axes around others.
OrientedBox box_around(const std::string& name, std::span<const OrientedBox> boxes, const Matrix3d& R_WO,
                       double margin) {
  Eigen::AlignedBox3d extent;  // in O
  for (const OrientedBox& box : boxes) {
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3d sign(corner & 1 ? 0.5 : -0.5, corner & 2 ? 0.5 : -0.5, corner & 4 ? 0.5 : -0.5);
      extent.extend(Vector3d(R_WO.transpose() * (box.center + box.R_WO * sign.cwiseProduct(box.size))));
    }
  }
  OrientedBox around;
  around.name = name;
  around.center = R_WO * extent.center();
  around.size = extent.sizes() + Vector3d::Constant(2.0 * margin);
  around.R_WO = R_WO;
  return around;
}

/// Puts one box around the two that waste the least space together.
void merge_two(std::vector<OrientedBox>& boxes) {
  OrientedBox best;
  std::size_t first = 0, second = 0;
  double least_waste = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t j = i + 1; j < boxes.size(); ++j) {
      const OrientedBox pair[] = {boxes[i], boxes[j]};
      const OrientedBox both = box_around(boxes[i].name + "_and_" + boxes[j].name, pair, boxes[i].R_WO, 0.0);
      const double waste = both.size.prod() - boxes[i].size.prod() - boxes[j].size.prod();
      if (waste < least_waste) std::tie(best, first, second, least_waste) = std::tuple(both, i, j, waste);
    }
  }
  if (second == 0) return;  // there is but one
  boxes[first] = best;
  boxes.erase(boxes.begin() + static_cast<std::ptrdiff_t>(second));
}

/// Cuts the longest box in two across its longest edge.
/// @param share  of the first part.
void split_longest(std::vector<OrientedBox>& boxes, double share) {
  const auto longest = std::max_element(boxes.begin(), boxes.end(), [](const OrientedBox& a, const OrientedBox& b) {
    return a.size.maxCoeff() < b.size.maxCoeff();
  });
  Eigen::Index axis = 0;
  const double length = longest->size.maxCoeff(&axis);
  if (length < kLongBox) return;
  OrientedBox low = *longest, high = *longest;
  low.size[axis] = share * length;
  high.size[axis] = length - low.size[axis];
  low.center -= 0.5 * high.size[axis] * longest->R_WO.col(axis);
  high.center += 0.5 * low.size[axis] * longest->R_WO.col(axis);
  low.name += "_a";
  high.name += "_b";
  *longest = low;
  boxes.push_back(high);
}

}  // namespace

void vary_boxes(Scene& scene, std::uint64_t scene_seed) {
  if (scene_seed == 0) return;
  RandomStream random(scene_seed, "scene_boxes", 0);
  const double kind = random.uniform();
  if (kind < kSingleBox) {
    const double heading = random.uniform(-0.25 * std::numbers::pi, 0.25 * std::numbers::pi);
    scene.boxes = {box_around("site", scene.boxes, rotation_z(heading), random.uniform(0.0, kLargestMargin))};
    return;
  }
  if (kind < kSingleBox + kMerge) merge_two(scene.boxes);
  if (random.uniform() < kSplit) split_longest(scene.boxes, random.uniform(0.35, 0.65));
  for (OrientedBox& box : scene.boxes) {
    const double turn =
        random.uniform(-1.0, 1.0) * std::min(kLargestTurn, kLargestSwing / box.size.head<2>().maxCoeff());
    const OrientedBox old[] = {box};
    box = box_around(box.name, old, rotation_z(turn) * box.R_WO, random.uniform(0.0, kLargestMargin));
  }
}

}  // namespace skein::sim
