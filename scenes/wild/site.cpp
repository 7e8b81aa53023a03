#include "scenes/wild/site.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/math/euler.hpp"
#include "core/scoring/camera_quality.hpp"
#include "scenes/variation.hpp"

namespace skein::sim::wild {
namespace {

constexpr double kAreaRate = 0.35;  ///< surface [m2] that a UAV inspects per second, and per metre of d*
constexpr double kLeastArea = 300.0, kMostArea = 14000.0;
constexpr double kLeastPart = 120.0;  ///< mean area per structure, at least
constexpr double kOpenness = 1.6;  ///< factor for open structures, which have less surface than a block of their size
constexpr double kShortest = 2.0, kLongest = 90.0, kHighest = 80.0;
constexpr std::size_t kMostBoxes = 15;

Vector2d heading_vector(double heading) { return {std::cos(heading), std::sin(heading)}; }
double draw_heading(RandomStream& random) { return random.uniform(-std::numbers::pi, std::numbers::pi); }

/// Size of a structure of this kind with about this surface area.
Vector3d draw_size(const Kind& kind, double area, RandomStream& random) {
  Vector3d size;
  for (int axis = 0; axis < 3; ++axis) size[axis] = random.uniform(kind.least[axis], kind.most[axis]);
  const double unit = 2.0 * (size.x() * size.y() + size.x() * size.z() + size.y() * size.z());
  size *= std::sqrt(area / unit);
  return size.cwiseMax(kShortest).cwiseMin(Vector3d(kLongest, kLongest, kHighest));
}

/// A place beside an existing structure; the gap may be negative, so that the two overlap.
Vector2d draw_place(const std::vector<Standing>& others, double radius, RandomStream& random) {
  if (others.empty()) return {random.uniform(-30.0, 40.0), random.uniform(-30.0, 40.0)};
  const Standing& near = others[static_cast<std::size_t>(random.uniform() * static_cast<double>(others.size()))];
  const double heading = draw_heading(random), gap = random.uniform(-0.25 * radius, 16.0);
  Vector2d place = near.p_W + (near.radius + radius + gap) * heading_vector(heading);
  const auto tight = [&](const Standing& other) {
    return (other.p_W - place).norm() < other.radius + radius + std::min(gap, 0.0) - 0.01;
  };
  while (std::ranges::any_of(others, tight)) place += 2.0 * heading_vector(heading);
  return place;
}

/// Splits a box across its longest edge into two boxes, which may overlap.
std::vector<OrientedBox> split(const OrientedBox& box, RandomStream& random) {
  Eigen::Index axis = 0;
  const double length = box.size.maxCoeff(&axis), share = random.uniform(0.3, 0.7);
  const double overlap = random.uniform() < 0.5 ? 0.0 : random.uniform(0.0, 0.2) * length;
  std::vector<OrientedBox> parts = {box, box};
  parts[0].size[axis] = share * length + overlap;
  parts[1].size[axis] = (1.0 - share) * length + overlap;
  parts[0].center -= 0.5 * (length - parts[0].size[axis]) * box.R_WO.col(axis);
  parts[1].center += 0.5 * (length - parts[1].size[axis]) * box.R_WO.col(axis);
  return parts;
}

std::vector<OrientedBox> boxes_of(const Standing& structure, RandomStream& random) {
  const double kind = random.uniform();
  double turn = random.uniform() < 0.4 ? random.uniform(-0.6, 0.6) : 0.0;
  Matrix3d R_WO = rotation_z(structure.heading + turn);
  if (random.uniform() < 0.1) {
    R_WO = R_WO * Eigen::AngleAxisd(random.uniform(-0.2, 0.2), Vector3d::UnitX()).toRotationMatrix();
  }
  OrientedBox box = enclosing_box("", structure.mesh, 0, R_WO, random.uniform(0.1, 1.0));
  if (kind < 0.35) return {box};
  if (kind < 0.7) {
    loosen(box, random);
    return {box};
  }
  if (kind < 0.85) return split(box, random);
  const double cut = random.uniform(0.2, 0.5) * box.size.z();  // only the upper part of the box remains
  box.center += 0.5 * cut * box.R_WO.col(2);
  box.size.z() -= cut;
  return {box};
}

TriangleMesh joined_mesh(const std::vector<Standing>& structures) {
  TriangleMesh all;
  for (const Standing& structure : structures) append(all, structure.mesh);
  return all;
}

/// A box above all starts and around the upper part of the highest structure; it begins some metres above the ground.
OrientedBox hanging_box(const std::vector<Standing>& structures, const std::vector<Vector2d>& starts,
                        RandomStream& random) {
  const Standing& high = *std::ranges::max_element(structures, {}, &Standing::height);
  TriangleMesh held = high.mesh;
  for (const Vector2d& start : starts) {
    held.vertices.emplace_back(static_cast<float>(start.x()), static_cast<float>(start.y()),
                               static_cast<float>(high.height));
  }
  OrientedBox box = enclosing_box("", held, 0, rotation_z(draw_heading(random)), random.uniform(0.5, 4.0));
  const double bottom = random.uniform(4.0, std::max(4.5, 0.5 * high.height));
  const double top = high.height + random.uniform(0.5, 6.0);
  box.center.z() = 0.5 * (bottom + top);
  box.size.z() = top - bottom;
  return box;
}

OrientedBox empty_box(const std::vector<Standing>& structures, RandomStream& random) {
  const Standing& near = structures.front();
  const Vector2d p_W = near.p_W + (near.radius + random.uniform(10.0, 40.0)) * heading_vector(draw_heading(random));
  OrientedBox box;
  box.size = Vector3d(random.uniform(4.0, 25.0), random.uniform(4.0, 25.0), random.uniform(4.0, 25.0));
  box.center << p_W, 0.5 * box.size.z() + random.uniform(0.0, 12.0);
  box.R_WO = rotation_z(draw_heading(random));
  return box;
}

}  // namespace

Task draw_task(const Dice& dice, bool blind) {
  RandomStream random = dice.stream("wild_task");
  Task task;
  const int uavs = draw_count(random, 1, 8);
  const bool any = random.uniform() < 0.15;
  const int explorers = draw_count(random, 1, any ? uavs : (uavs + 1) / 2);
  for (int i = 0; i < uavs; ++i) task.fleet.push_back(!blind && i < explorers ? Role::explorer : Role::photographer);
  if (random.uniform() < 0.3) {  // shuffle the fleet
    for (std::size_t i = task.fleet.size(); i > 1; --i) {
      std::swap(task.fleet[i - 1], task.fleet[static_cast<std::size_t>(random.uniform() * static_cast<double>(i))]);
    }
  }
  task.mm_per_pixel = std::round(100.0 * random.uniform(0.8, 3.0)) / 100.0;
  task.duration_s = 10.0 * draw_count(random, 12, 60);
  const double capacity =
      static_cast<double>(uavs) * task.duration_s * kAreaRate * resolution_distance(CameraConfig(), task.mm_per_pixel);
  task.area_m2 = std::clamp(random.uniform(0.4, 2.0) * capacity, kLeastArea, kMostArea);
  return task;
}

std::vector<Standing> draw_structures(const Dice& dice, double area_m2) {
  RandomStream random = dice.stream("wild_structures");
  const int count = std::min(draw_count(random, 1, 6), std::max(1, static_cast<int>(area_m2 / kLeastPart)));
  std::vector<double> shares;
  double sum = 0.0;
  for (int i = 0; i < count; ++i) sum += shares.emplace_back(random.uniform(0.3, 1.0));
  std::vector<Standing> structures;
  for (int i = 0; i < count; ++i) {
    RandomStream own(dice.seed, "wild_structure", static_cast<std::uint64_t>(i), dice.attempt);
    const std::size_t solids = solid_kinds().size(), all = solids + open_kinds().size();
    const auto which = static_cast<std::size_t>(own.uniform() * static_cast<double>(all));
    const bool open = which >= solids;
    const Kind& kind = open ? open_kinds()[which - solids] : solid_kinds()[which];
    const double area = area_m2 * shares[static_cast<std::size_t>(i)] / sum * (open ? kOpenness : 1.0);
    const Vector3d size = draw_size(kind, area, own);
    Standing standing;
    standing.radius = 0.5 * size.head<2>().norm();
    standing.heading = draw_heading(own);
    standing.p_W = draw_place(structures, standing.radius, own);
    MeshBuilder builder;
    kind.add(builder, standing_at(standing.p_W, standing.heading), size, own);
    standing.mesh = builder.take();
    for (const auto& vertex : standing.mesh.vertices) standing.height = std::max(standing.height, double{vertex.z()});
    structures.push_back(std::move(standing));
  }
  return structures;
}

std::vector<OrientedBox> draw_boxes(const Dice& dice, const std::vector<Standing>& structures,
                                    const std::vector<Vector2d>& starts) {
  RandomStream random = dice.stream("wild_boxes");
  std::vector<OrientedBox> boxes;
  const double kind = random.uniform();
  if (kind < 0.15) {  // one around everything
    const double heading = draw_heading(random);
    boxes.push_back(enclosing_box("", joined_mesh(structures), 0, rotation_z(heading), random.uniform(0.5, 3.0)));
    if (random.uniform() < 0.4) loosen(boxes.back(), random);
  } else {
    for (const Standing& structure : structures) {
      const auto some = boxes_of(structure, random);
      boxes.insert(boxes.end(), some.begin(), some.end());
    }
    if (kind < 0.4) boxes.push_back(hanging_box(structures, starts, random));
  }
  const int empty = random.uniform() < 0.3 ? draw_count(random, 1, 2) : 0;
  for (int i = 0; i < empty; ++i) boxes.push_back(empty_box(structures, random));
  if (boxes.size() > kMostBoxes) boxes.resize(kMostBoxes);
  for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i].name = "box_" + std::to_string(i + 1);
  return boxes;
}

bool in_any_box(const TriangleMesh& mesh, const std::vector<OrientedBox>& boxes) {
  constexpr double kMargin = 0.1;
  return std::ranges::any_of(mesh.vertices, [&](const Eigen::Vector3f& vertex) {
    return std::ranges::any_of(boxes,
                               [&](const OrientedBox& box) { return box.contains(vertex.cast<double>(), kMargin); });
  });
}

}  // namespace skein::sim::wild
