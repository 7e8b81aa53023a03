#include "scenes/tower_crane.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/euler.hpp"
#include "scenes/hoist.hpp"
#include "scenes/lattice.hpp"

namespace skein::sim {
namespace {

constexpr double kTurntable = 1.8;    ///< height of the turntable, between the mast and the foot of the jib
constexpr double kCounterHalf = 0.9;  ///< half the width of the counter-jib

Polygon square(double edge) { return rectangle(Vector2d::Zero(), {edge, edge}); }

int fields(double length, double field) { return std::max(2, static_cast<int>(std::lround(length / field))); }

class TowerCrane {
 public:
  TowerCrane(MeshBuilder& builder, const TowerCranePlan& plan, RandomStream& random)
      : builder_(builder),
        plan_(plan),
        random_(random),
        width_(random.uniform(0.024, 0.030) * plan.height + 0.3),
        head_(random.uniform(0.115, 0.14) * plan.height),
        counter_jib_(random.uniform(0.27, 0.33) * plan.jib_length),
        jib_height_(random.uniform(1.5, 2.1)),
        brace_(random.uniform(0.05, 0.07)) {
    X_WS_ = plan.X_WC;
    X_WS_.linear() = rotation_z(plan.jib_heading);
    X_WS_.translation().z() = plan.height - head_;
  }

  std::vector<OrientedBox> build() {
    std::vector<OrientedBox> boxes;
    const auto part = [&](const char* name, const Matrix3d& R_WO, auto&&... steps) {
      const std::size_t first = builder_.mesh().vertices.size();
      (steps(), ...);
      boxes.push_back(enclosing_box(plan_.name + name, builder_.mesh(), first, R_WO, kBoxMargin));
    };
    part(
        "_mast", plan_.X_WC.linear(), [&] { add_foundation(); }, [&] { add_mast(); });
    part(
        "_head", X_WS_.linear(), [&] { add_turntable(); }, [&] { add_head(); }, [&] { add_cabin(); });
    part(
        "_jib", X_WS_.linear(), [&] { add_jib(); }, [&] { add_jib_ties(); });
    part(
        "_counter_jib", X_WS_.linear(), [&] { add_counter_jib(); }, [&] { add_ballast(); });
    part("_hook", X_WS_.linear(), [&] { add_trolley(); });
    return boxes;
  }

 private:
  double mast_top() const { return plan_.height - head_ - kTurntable; }
  Vector3d apex() const { return {0.0, 0.0, head_ - 0.4}; }
  double jib_root() const { return 0.4 * width_; }

  /// A box in S, the frame of the slewing part: origin in the middle of the jib's foot, x along the jib.
  void box(const Vector3d& center, const Vector3d& size) {
    builder_.add_box(X_WS_ * Eigen::Translation3d(center), size);
  }
  void member(const Vector3d& from, const Vector3d& to, double thickness) {
    builder_.add_member(X_WS_ * from, X_WS_ * to, thickness);
  }

  void add_foundation() {
    const double edge = width_ + random_.uniform(3.0, 4.5), thickness = random_.uniform(0.7, 1.2);
    builder_.add_prism(plan_.X_WC, square(edge), kSunk, thickness);
    const double block = random_.uniform(1.0, 1.4), reach = 0.5 * edge - 0.6 * block;
    const double height = thickness + random_.uniform(0.8, 2.2);
    for (const double x : {-reach, reach}) {
      for (const double y : {-reach, reach}) {
        builder_.add_prism(plan_.X_WC, rectangle({x, y}, {block, block}, 0.08), thickness - 0.1, height);
      }
    }
  }

  void add_mast() {
    const double foot = 0.5, length = mast_top() - foot;
    const LatticeStyle style{0.085 * width_, brace_, random_.uniform() < 0.5};
    Isometry3d X_WL = plan_.X_WC * Eigen::Translation3d(0, 0, foot);
    add_square_truss(X_WL, width_, length, fields(length, width_ * random_.uniform(0.95, 1.25)), style);

    // The climbing collar, with a platform below and one above.
    const double collar = random_.uniform(5.0, 7.0), wide = width_ + 0.5;
    X_WL = plan_.X_WC * Eigen::Translation3d(0, 0, random_.uniform(0.45, 0.85) * mast_top() - 0.5 * collar);
    add_square_truss(X_WL, wide, collar, 3, {0.14, brace_ + 0.02, true});
    for (const double z : {0.0, collar}) {
      const double middle = 0.5 * (width_ + 1.3), length_of_edge = width_ + 2.1;
      for (const double side : {-1.0, 1.0}) {
        builder_.add_box(X_WL * Eigen::Translation3d(0, side * middle, z), {length_of_edge, 0.8, 0.08});
        builder_.add_box(X_WL * Eigen::Translation3d(side * middle, 0, z), {0.8, length_of_edge - 1.6, 0.08});
        const double edge = 0.5 * length_of_edge;
        const auto rail = [&](const Vector3d& a, const Vector3d& b) {
          add_railing(builder_, X_WL * a, X_WL * b, Vector3d::UnitZ());
        };
        rail({-edge, side * edge, z}, {edge, side * edge, z});
        rail({side * edge, -edge, z}, {side * edge, edge, z});
      }
    }
  }

  void add_square_truss(const Isometry3d& X_WL, double width, double length, int count, const LatticeStyle& style) {
    add_lattice(builder_, cross_sections(X_WL, square(width), square(width), length, count), style);
  }

  void add_turntable() {
    const Vector3d foot(0, 0, -kTurntable - 0.2), top(0, 0, -0.8);
    builder_.add_cylinder(X_WS_ * foot, X_WS_ * top, 0.72 * width_, 20);
    box({0, 0, -0.45}, {width_ + 1.2, width_ + 1.0, 0.9});
  }

  void add_head() {
    const Isometry3d X_WL = X_WS_ * Eigen::Translation3d(0, 0, -0.1);
    const LatticeStyle style{0.15, brace_ + 0.01, random_.uniform() < 0.5};
    add_lattice(builder_, cross_sections(X_WL, square(0.9 * width_), square(0.45), head_ - 0.3, fields(head_, 2.0)),
                style);
    box(apex(), {0.8, 0.7, 0.8});
  }

  void add_cabin() {
    const double side = random_.uniform() < 0.5 ? -1.0 : 1.0;
    const Vector3d center(0.5 * width_ + 0.6, side * (0.5 * width_ + 1.15), random_.uniform(-0.3, 0.3));
    box(center, {1.9, 1.5, 2.2});
    box(center + Vector3d(0.1, 0, 1.15), {2.3, 1.8, 0.14});
    box(center + Vector3d(0, 0, -1.15), {2.0, 1.6, 0.12});
  }

  /// Height of the top chord over the bottom chords.
  double depth(double along) const { return jib_height_ * (1.0 - 0.5 * along / plan_.jib_length); }

  void add_jib() {
    const auto triangle = [](double height) { return Polygon{{-0.75, 0.0}, {0.75, 0.0}, {0.0, height}}; };
    const double length = plan_.jib_length - jib_root();
    const Vector3d root(jib_root(), 0, 0.15), tip(plan_.jib_length, 0, 0.15);
    const Isometry3d X_WL = frame_along(X_WS_ * root, X_WS_ * tip);
    const LatticeStyle style{random_.uniform(0.12, 0.18), brace_, false};
    add_lattice(builder_,
                cross_sections(X_WL, triangle(depth(0.0)), triangle(depth(plan_.jib_length)), length,
                               fields(length, random_.uniform(1.6, 2.2))),
                style);
    box({plan_.jib_length, 0, 0.4}, {0.25, 1.7, 0.5});  // buffer at the tip
    // A narrow catwalk on one of the bottom chords.
    const double side = random_.uniform() < 0.5 ? -1.0 : 1.0;
    box({jib_root() + 0.25 * length, side * 0.45, 0.2}, {0.5 * length, 0.4, 0.06});
  }

  void add_jib_ties() {
    const double bar = random_.uniform(0.07, 0.11);
    for (const double share : {random_.uniform(0.3, 0.4), random_.uniform(0.72, 0.84)}) {
      const double along = share * plan_.jib_length;
      member(apex(), {along, 0, 0.15 + depth(along)}, bar);
    }
  }

  void add_counter_jib() {
    const double length = counter_jib_, middle = -0.5 * (length + jib_root());
    for (const double side : {-1.0, 1.0}) {
      box({middle, side * kCounterHalf, 0.15}, {length - jib_root(), 0.18, 0.36});
      add_railing(builder_, X_WS_ * Vector3d(-jib_root() - 0.8, side * (kCounterHalf + 0.05), 0.3),
                  X_WS_ * Vector3d(-length + 0.1, side * (kCounterHalf + 0.05), 0.3), Vector3d::UnitZ());
      member(apex(), {-length + 2.5, side * kCounterHalf, 0.25}, 0.09);
    }
    const int frames = fields(length, 2.0);
    for (int i = 0; i <= frames; ++i) {
      const double x = -jib_root() - (length - jib_root()) * i / frames;
      member({x, -kCounterHalf, 0.15}, {x, kCounterHalf, 0.15}, 0.12);
      const double next = x - (length - jib_root()) / frames, side = i % 2 == 0 ? 1.0 : -1.0;
      if (i < frames) member({x, side * kCounterHalf, 0.05}, {next, -side * kCounterHalf, 0.05}, brace_);
    }
    box({middle, 0, 0.36}, {length - jib_root() - 0.4, 2.0 * kCounterHalf - 0.1, 0.06});
    const double house = random_.uniform(2.4, 3.6);
    box({-random_.uniform(0.4, 0.55) * length, 0, 1.25}, {house, 1.5, 1.8});
  }

  void add_ballast() {
    const int slabs = 3 + static_cast<int>(random_.uniform(0.0, 3.0));
    const double height = random_.uniform(2.2, 3.4), top = random_.uniform(0.5, 1.0);
    for (int i = 0; i < slabs; ++i) {
      box({-counter_jib_ + 0.5 + 0.62 * i, 0, top - 0.5 * height}, {0.5, 2.0 * kCounterHalf - 0.25, height});
    }
  }

  void add_trolley() {
    const double x = plan_.trolley * plan_.jib_length;
    box({x, 0, -0.15}, {2.0, 1.7, 0.22});
    for (const double along : {-0.7, 0.7}) {
      for (const double side : {-0.75, 0.75}) {
        builder_.add_cylinder(X_WS_ * Vector3d(x + along, side - 0.1, 0.0),
                              X_WS_ * Vector3d(x + along, side + 0.1, 0.0), 0.22, 10);
      }
    }
    add_hoist(builder_, X_WS_ * Eigen::Translation3d(x, 0, -0.2), random_.uniform(5.0, 16.0), random_);
  }

  MeshBuilder& builder_;
  const TowerCranePlan& plan_;
  RandomStream& random_;
  double width_, head_, counter_jib_, jib_height_, brace_;
  Isometry3d X_WS_;  ///< of the slewing part
};

}  // namespace

std::vector<OrientedBox> add_tower_crane(MeshBuilder& builder, const TowerCranePlan& plan, RandomStream& random) {
  return TowerCrane(builder, plan, random).build();
}

}  // namespace skein::sim
