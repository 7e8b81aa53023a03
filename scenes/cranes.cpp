#include "scenes/cranes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "core/math/random_stream.hpp"
#include "scenes/hoist.hpp"
#include "scenes/lattice.hpp"
#include "scenes/surface_sampling.hpp"
#include "scenes/tower_crane.hpp"
#include "scenes/variation.hpp"

namespace skein::sim {
namespace {

constexpr std::size_t kCranesPoints = 3600;
constexpr double kPi = std::numbers::pi;

// ------------------------------------------------------------------------------------------------------ tower cranes
// The fleet starts along the x axis; the cranes stand some 50 m from it in y, and 76 m from each other. Their jibs turn
// on the far side. The low crane's jib ends before the high crane's mast, and the high crane's hook never reaches the
// low crane's jib.

std::vector<OrientedBox> add_low_crane(MeshBuilder& builder, std::uint64_t scene_seed) {
  RandomStream random(scene_seed, "cranes_low", 0);
  TowerCranePlan plan;
  plan.name = "low";
  const Vector2d foot{8.0 + random.uniform(-2.0, 2.0), 50.0 + random.uniform(-2.0, 3.0)};
  plan.X_WC = standing_at(foot, random.uniform(-0.25 * kPi, 0.25 * kPi));
  plan.height = random.uniform(57.0, 63.0);
  plan.jib_length = random.uniform(40.0, 46.0);
  plan.jib_heading = random.uniform(-0.6, kPi + 0.6);
  plan.trolley = random.uniform(0.2, 0.9);
  return add_tower_crane(builder, plan, random);
}

std::vector<OrientedBox> add_high_crane(MeshBuilder& builder, std::uint64_t scene_seed) {
  RandomStream random(scene_seed, "cranes_high", 0);
  TowerCranePlan plan;
  plan.name = "high";
  const Vector2d foot{84.0 + random.uniform(-2.0, 2.0), 52.0 + random.uniform(-2.0, 3.0)};
  plan.X_WC = standing_at(foot, random.uniform(-0.25 * kPi, 0.25 * kPi));
  plan.height = random.uniform(77.0, 83.0);
  plan.jib_length = random.uniform(50.0, 58.0);
  plan.jib_heading = random.uniform(-0.5, kPi + 0.5);
  plan.trolley = random.uniform(0.15, 0.34);
  return add_tower_crane(builder, plan, random);
}

// ------------------------------------------------------------------------------------------------------ gantry crane

/// Frame G: origin on the ground below the middle of the girder, x along the girder, y along the rails.
class GantryCrane {
 public:
  GantryCrane(MeshBuilder& builder, const Isometry3d& X_WG, RandomStream& random)
      : builder_(builder),
        X_WG_(X_WG),
        random_(random),
        span_(random.uniform(26.0, 34.0)),
        overhang_(random.uniform(4.0, 7.0)),
        height_(random.uniform(13.5, 17.5)),
        base_(random.uniform(7.0, 9.5)),
        depth_(random.uniform(1.7, 2.4)),
        brace_(random.uniform(0.05, 0.07)) {}

  std::vector<OrientedBox> build() {
    std::vector<OrientedBox> boxes;
    const auto part = [&](const char* name, auto&& steps) {
      const std::size_t first = builder_.mesh().vertices.size();
      steps();
      boxes.push_back(enclosing_box(name, builder_.mesh(), first, X_WG_.linear(), kBoxMargin));
    };
    part("gantry_leg_1", [&] { add_leg(-0.5 * span_); });
    part("gantry_leg_2", [&] { add_leg(0.5 * span_); });
    const double trolley = random_.uniform(-0.28, 0.28) * span_;
    part("gantry_girder", [&] { add_girder(trolley); });
    const Isometry3d X_WT = X_WG_ * Eigen::Translation3d(trolley, 0, height_ + depth_ + 0.4);
    part("gantry_hook", [&] { add_hoist(builder_, X_WT, depth_ + random_.uniform(2.0, 0.25 * height_), random_); });
    for (const double side : {-0.5, 0.5}) box({side * span_, 0, 0.0}, {0.3, base_ + 14.0, 0.3});  // rails
    return boxes;
  }

 private:
  void box(const Vector3d& center, const Vector3d& size) {
    builder_.add_box(X_WG_ * Eigen::Translation3d(center), size);
  }
  void member(const Vector3d& from, const Vector3d& to, double thickness) {
    builder_.add_member(X_WG_ * from, X_WG_ * to, thickness);
  }

  /// Two inclined trusses on a sill that runs on bogies, with a beam across their heads.
  void add_leg(double x) {
    box({x, 0, 1.25}, {0.8, base_ + 1.6, 0.7});
    box({x, 0, height_ - 0.35}, {1.5, 4.4, 0.8});
    const LatticeStyle style{0.14, brace_, random_.uniform() < 0.5};
    for (const double side : {-1.0, 1.0}) {
      const Vector3d foot = X_WG_ * Vector3d(x, side * 0.5 * base_, 1.4),
                     head = X_WG_ * Vector3d(x, side * 1.5, height_ - 0.5);
      const double length = (head - foot).norm();
      add_lattice(builder_,
                  cross_sections(frame_along(foot, head), rectangle({0, 0}, {0.7, 0.7}), rectangle({0, 0}, {1.1, 1.1}),
                                 length, static_cast<int>(std::lround(length / 1.15))),
                  style);
      box({x, side * 0.5 * base_, 0.7}, {0.9, 2.2, 0.6});
      for (const double wheel : {-0.65, 0.65}) {
        const double y = side * 0.5 * base_ + wheel;
        builder_.add_cylinder(X_WG_ * Vector3d(x - 0.2, y, 0.5), X_WG_ * Vector3d(x + 0.2, y, 0.5), 0.38, 12);
      }
    }
    const double low = 0.45 * height_, half = 0.5 * base_ + (1.5 - 0.5 * base_) * (low - 1.4) / (height_ - 1.9);
    member({x, -half, low}, {x, half, low}, 0.25);
  }

  /// @param trolley  its position along x.
  void add_girder(double trolley) {
    add_trusses();
    add_walkway();
    add_cabin();
    add_trolley(trolley);
  }

  /// Two parallel trusses; the hoist runs between them.
  void add_trusses() {
    const double length = span_ + 2.0 * overhang_;
    const int fields = static_cast<int>(std::lround(length / random_.uniform(1.7, 2.3)));
    const LatticeStyle style{random_.uniform(0.16, 0.22), brace_, false};
    for (const double side : {-1.0, 1.0}) {
      const Vector3d from(-0.5 * length, side * kTruss, height_), to(0.5 * length, side * kTruss, height_);
      const Polygon section = rectangle({0, 0.5 * depth_}, {0.8, depth_});
      add_lattice(builder_, cross_sections(frame_along(X_WG_ * from, X_WG_ * to), section, section, length, fields),
                  style);
    }
    for (const double x : {-0.5, 0.5}) {
      box({x * length, 0, height_ + 0.5 * depth_}, {0.3, 2.0 * kTruss + 0.8, depth_ + 0.3});
    }
  }

  void add_walkway() {
    const double length = span_ + 2.0 * overhang_, side = random_.uniform() < 0.5 ? -1.0 : 1.0;
    const double y = side * (kTruss + 0.75), rail = side * (kTruss + 1.1);
    box({0, y, height_ + 0.03}, {length, 0.8, 0.06});
    add_railing(builder_, X_WG_ * Vector3d(-0.5 * length, rail, height_), X_WG_ * Vector3d(0.5 * length, rail, height_),
                Vector3d::UnitZ());
  }

  void add_cabin() {
    const double side = random_.uniform() < 0.5 ? -1.0 : 1.0;
    const Vector3d center(side * (0.5 * span_ - 3.0), (random_.uniform() < 0.5 ? -1.0 : 1.0) * kTruss, height_ - 1.2);
    box(center, {2.2, 1.7, 2.2});
    box(center + Vector3d(0, 0, 1.05), {2.5, 2.0, 0.3});
  }

  void add_trolley(double x) {
    const double top = height_ + depth_;
    box({x, 0, top + 0.5}, {3.4, 2.0 * kTruss + 1.0, 0.4});
    for (const double along : {-1.2, 1.2}) {
      for (const double side : {-1.0, 1.0}) {
        const double y = side * kTruss;
        builder_.add_cylinder(X_WG_ * Vector3d(x + along, y - 0.15, top + 0.25),
                              X_WG_ * Vector3d(x + along, y + 0.15, top + 0.25), 0.3, 12);
      }
    }
    const double side = random_.uniform() < 0.5 ? -1.0 : 1.0;
    box({x, side * 0.9, top + 1.3}, {random_.uniform(2.0, 3.0), 1.5, 1.5});
    builder_.add_cylinder(X_WG_ * Vector3d(x - 1.2, -side * 0.7, top + 1.1),
                          X_WG_ * Vector3d(x + 1.2, -side * 0.7, top + 1.1), 0.45, 16);
    for (const double end : {-1.0, 1.0}) box({x + end, -side * 0.7, top + 0.95}, {0.12, 1.0, 0.9});
  }

  static constexpr double kTruss = 1.5;  ///< from the middle of the girder to the middle of a truss

  MeshBuilder& builder_;
  Isometry3d X_WG_;
  RandomStream& random_;
  double span_, overhang_, height_, base_, depth_, brace_;
};

std::vector<OrientedBox> add_gantry(MeshBuilder& builder, std::uint64_t scene_seed) {
  RandomStream random(scene_seed, "cranes_gantry", 0);
  const Vector2d middle{47.0 + random.uniform(-3.0, 3.0), 48.0 + random.uniform(-4.0, 8.0)};
  return GantryCrane(builder, standing_at(middle, random.uniform(-0.5, 0.5)), random).build();
}

}  // namespace

UnsampledScene make_cranes(std::uint64_t scene_seed) {
  MeshBuilder builder;
  Scene scene;
  for (const auto add : {&add_low_crane, &add_high_crane, &add_gantry}) {
    const std::vector<OrientedBox> boxes = add(builder, scene_seed);
    scene.boxes.insert(scene.boxes.end(), boxes.begin(), boxes.end());
  }
  scene.mesh = builder.take();
  vary_boxes(scene, scene_seed);
  return {std::move(scene), kCranesPoints, scene_seed};
}

}  // namespace skein::sim
