#include "scenes/variation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <tuple>

#include "core/math/euler.hpp"
#include "core/math/random_stream.hpp"
#include "core/scenario/scene_families.hpp"
#include "scenes/mesh_builder.hpp"

namespace skein::sim {
namespace {

/// Shares of the seeds with which the scene gets a single box, two boxes are merged, and the longest box is split.
constexpr double kSingleBoxShare = 0.25, kMergeShare = 0.3, kSplitShare = 0.3;
constexpr double kLargestTurn = 0.12;   ///< of a box about z [rad]
constexpr double kLargestSwing = 2.0;   ///< limit of turn [rad] times length [m]: long boxes turn less
constexpr double kLargestMargin = 1.0;  ///< greatest addition to the family's own margin [m]
constexpr double kLongBox = 30.0;       ///< least length of a box that may be split [m]

/// The smallest box with the given axes that contains all `boxes`, enlarged by the margin.
OrientedBox box_around(const std::string& name, std::span<const OrientedBox> boxes, const Matrix3d& R_WO,
                       double margin) {
  Eigen::AlignedBox3d extent;  // in O, the frame of the new box
  for (const OrientedBox& box : boxes) {
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3d sign(corner & 1 ? 0.5 : -0.5, corner & 2 ? 0.5 : -0.5, corner & 4 ? 0.5 : -0.5);
      extent.extend(Vector3d(R_WO.transpose() * (box.center + box.R_WO * sign.cwiseProduct(box.size))));
    }
  }
  return box_of_extent(name, extent, R_WO, margin);
}

/// Merges two boxes into one around both. Chooses the pair for which this adds the least volume.
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
  if (second == 0) return;  // there is only one box
  boxes[first] = best;
  boxes.erase(boxes.begin() + static_cast<std::ptrdiff_t>(second));
}

/// Cuts the longest box in two across its longest edge, if it is long enough.
/// @param share  length of the first part, as a share of the whole.
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

/// The variation that every seed except 0 gives.
void vary_for_nonzero_seeds(Scene& scene, std::uint64_t scene_seed) {
  RandomStream random(scene_seed, "scene_boxes", 0);
  const double kind = random.uniform();
  if (kind < kSingleBoxShare) {
    const double heading = random.uniform(-0.25 * std::numbers::pi, 0.25 * std::numbers::pi);
    scene.boxes = {box_around("site", scene.boxes, rotation_z(heading), random.uniform(0.0, kLargestMargin))};
    return;
  }
  if (kind < kSingleBoxShare + kMergeShare) merge_two(scene.boxes);
  if (random.uniform() < kSplitShare) split_longest(scene.boxes, random.uniform(0.35, 0.65));
  for (OrientedBox& box : scene.boxes) {
    const double turn =
        random.uniform(-1.0, 1.0) * std::min(kLargestTurn, kLargestSwing / box.size.head<2>().maxCoeff());
    const OrientedBox old[] = {box};
    box = box_around(box.name, old, rotation_z(turn) * box.R_WO, random.uniform(0.0, kLargestMargin));
  }
}

/// An empty or almost empty box beside another one.
OrientedBox idle_box(const OrientedBox& near, RandomStream& random) {
  const double heading = random.uniform(-std::numbers::pi, std::numbers::pi);
  const double away = 0.5 * near.size.head<2>().norm() + random.uniform(8.0, 25.0);
  OrientedBox box;
  box.name = "idle";
  box.size = {random.uniform(5.0, 20.0), random.uniform(5.0, 20.0), random.uniform(5.0, 25.0)};
  box.center << near.center.head<2>() + away * Vector2d(std::cos(heading), std::sin(heading)), 0.5 * box.size.z();
  box.R_WO = rotation_z(heading);
  return box;
}

/// Additional variation for seeds from kVariedSeeds on.
void vary_for_later_seeds(std::vector<OrientedBox>& boxes, std::uint64_t scene_seed) {
  constexpr double kLooseShare = 0.35;  // of the boxes
  constexpr double kIdleShare = 0.3;    // of the seeds
  RandomStream random(scene_seed, "scene_boxes_further", 0);
  for (OrientedBox& box : boxes) {
    if (random.uniform() < kLooseShare) loosen(box, random);
  }
  if (random.uniform() < kIdleShare) boxes.push_back(idle_box(boxes.front(), random));
}

}  // namespace

void loosen(OrientedBox& box, RandomStream& random) {
  const double factor = random.uniform(1.0, 4.0);
  Vector3d share(random.uniform(), random.uniform(), random.uniform());
  share /= std::max(1e-9, share.sum());
  for (int axis = 0; axis < 3; ++axis) {
    const double growth = (std::pow(factor, share[axis]) - 1.0) * box.size[axis];
    box.center += random.uniform(-0.5, 0.5) * growth * box.R_WO.col(axis);
    box.size[axis] += growth;
  }
}

void vary_boxes(Scene& scene, std::uint64_t scene_seed) {
  if (scene_seed == 0) return;
  vary_for_nonzero_seeds(scene, scene_seed);
  if (scene_seed >= kVariedSeeds) vary_for_later_seeds(scene.boxes, scene_seed);
}

}  // namespace skein::sim
