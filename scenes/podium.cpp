#include "scenes/podium.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skein::sim {
namespace {

constexpr double kPier = 0.9;  ///< thickness of the arcade's piers and arches

class Podium {
 public:
  Podium(MeshBuilder& builder, const PodiumPlan& plan, RandomStream& random)
      : builder_(builder),
        plan_(plan),
        random_(random),
        storey_(random.uniform(0.6, 0.68) * plan.height),
        arcade_(random.uniform(3.0, 4.0)),
        bay_(random.uniform(4.2, 6.0)),
        rise_(random.uniform(0.15, 0.5)) {}

  void build() {
    const Vector2d inner = plan_.size - Vector2d::Constant(2.0 * arcade_);
    builder_.add_prism(plan_.X_WP, rectangle({0, 0}, inner), kSunk, storey_ + 0.1);
    builder_.add_prism(plan_.X_WP, rectangle({0, 0}, plan_.size), storey_, plan_.height);
    builder_.add_prism(plan_.X_WP, rectangle({0, 0}, plan_.size + Vector2d(1.0, 1.0)), plan_.height - 0.9,
                       plan_.height - 0.4);
    for (int side = 0; side < 4; ++side) {
      const double length = side % 2 == 0 ? plan_.size.x() : plan_.size.y();
      const double reach = 0.5 * (side % 2 == 0 ? plan_.size.y() : plan_.size.x());
      const Isometry3d X_WF = plan_.X_WP * Eigen::AngleAxisd(0.5 * std::numbers::pi * side, Vector3d::UnitZ()) *
                              Eigen::Translation3d(0, -reach, 0);
      add_arcade(X_WF, length);
      add_upper_storey(X_WF, length);
    }
    add_canopy();
    add_roof();
  }

 private:
  // F is the frame of a facade: origin on the ground below its middle, x along it to the right, y inwards.

  void add_arcade(const Isometry3d& X_WF, double length) {
    const int bays = static_cast<int>(std::lround(length / bay_));
    const double bay = (length - kPier) / bays, y = 0.5 * kPier, opening = bay - kPier;
    for (int i = 0; i <= bays; ++i) {
      const double x = -0.5 * (length - kPier) + bay * i;
      builder_.add_box(X_WF * Eigen::Translation3d(x, y, 0.5 * (storey_ + kSunk)),
                       {kPier, kPier, storey_ - kSunk + 0.1});
      if (i < bays) add_arch(X_WF * Eigen::Translation3d(x + 0.5 * bay, y, 0), opening);
    }
  }

  /// The wall above an arch: upright slices between the arch and the ceiling.
  void add_arch(const Isometry3d& X_WA, double opening) {
    constexpr int kSlices = 8;
    const double height = rise_ * opening, crown = storey_ - 0.35;
    const auto under = [&](double x) {
      const double share = 2.0 * x / opening;
      return crown - height * (1.0 - std::sqrt(std::max(0.0, 1.0 - share * share)));
    };
    for (int i = 0; i < kSlices; ++i) {
      const double x0 = opening * (static_cast<double>(i) / kSlices - 0.5), x1 = x0 + opening / kSlices;
      Ring front = {{x0, -0.4 * kPier, under(x0)},
                    {x1, -0.4 * kPier, under(x1)},
                    {x1, -0.4 * kPier, storey_ + 0.05},
                    {x0, -0.4 * kPier, storey_ + 0.05}};
      Ring back = front;
      for (Vector3d& p : back) p.y() = 0.4 * kPier;
      for (Ring* ring : {&front, &back}) {
        for (Vector3d& p : *ring) p = X_WA * p;
      }
      const Ring rings[] = {back, front};
      builder_.add_loft(rings);
    }
  }

  /// Window surrounds over the arcade, and a parapet.
  void add_upper_storey(const Isometry3d& X_WF, double length) {
    const int windows = static_cast<int>(std::lround(length / bay_));
    const double pitch = length / windows, low = storey_ + 0.5, high = plan_.height - 1.2;
    for (int i = 0; i < windows; ++i) {
      const double x = -0.5 * length + pitch * (i + 0.5);
      for (const double side : {-1.0, 1.0}) {
        builder_.add_box(X_WF * Eigen::Translation3d(x + side * 0.3 * pitch, 0, 0.5 * (low + high)),
                         {0.3, 0.7, high - low});
      }
      builder_.add_box(X_WF * Eigen::Translation3d(x, 0, low), {0.6 * pitch + 0.6, 0.9, 0.2});
    }
    builder_.add_box(X_WF * Eigen::Translation3d(0, 0.25, plan_.height + 0.45), {length, 0.35, 1.1});
  }

  void add_canopy() {
    const double width = random_.uniform(8.0, 13.0), depth = random_.uniform(3.5, 5.0), x = random_.uniform(-8.0, 8.0);
    const double height = storey_ - random_.uniform(0.2, 0.8), front = -0.5 * plan_.size.y();
    builder_.add_box(plan_.X_WP * Eigen::Translation3d(x, front - 0.5 * depth + 0.5, height),
                     {width, depth + 1.0, 0.4});
    for (const double side : {-1.0, 1.0}) {
      const Vector3d foot(x + side * (0.5 * width - 0.5), front - depth + 0.6, kSunk);
      builder_.add_cylinder(plan_.X_WP * foot, plan_.X_WP * Vector3d(foot.x(), foot.y(), height), 0.25, 10);
    }
  }

  /// One object in each field of a grid, except where the tower stands.
  void add_roof() {
    const int columns = static_cast<int>(plan_.size.x() / 9.0), rows = static_cast<int>(plan_.size.y() / 9.0);
    const Vector2d field = (plan_.size - Vector2d::Constant(3.0)).cwiseQuotient(Vector2d(columns, rows));
    for (int i = 0; i < columns; ++i) {
      for (int j = 0; j < rows; ++j) {
        const Vector2d middle = Vector2d(i + 0.5 - 0.5 * columns, j + 0.5 - 0.5 * rows).cwiseProduct(field);
        const double kind = random_.uniform();
        if ((middle - plan_.tower).norm() < plan_.tower_radius + 0.45 * field.norm()) continue;
        add_roof_piece(plan_.X_WP * Eigen::Translation3d(middle.x(), middle.y(), plan_.height - 0.1), field, kind);
      }
    }
  }

  void add_roof_piece(const Isometry3d& X_WR, const Vector2d& field, double kind) {
    const Vector2d room = 0.5 * (field - Vector2d(1.5, 1.5));
    const Vector2d half{room.x() * random_.uniform(0.6, 1.0), room.y() * random_.uniform(0.6, 1.0)};
    if (kind < 0.3) {  // skylight
      const double lower = random_.uniform(0.5, 0.9), ridge = lower + random_.uniform(0.8, 1.8);
      builder_.add_prism(X_WR, rectangle({0, 0}, 2.0 * half), 0.0, lower);
      const auto ring = [&](double x, double y, double z) {
        return Ring{X_WR * Vector3d(-x, -y, z), X_WR * Vector3d(x, -y, z), X_WR * Vector3d(x, y, z),
                    X_WR * Vector3d(-x, y, z)};
      };
      const Ring rings[] = {ring(half.x() - 0.15, half.y() - 0.15, lower - 0.05), ring(half.x() - 0.8, 0.12, ridge)};
      builder_.add_loft(rings);
    } else if (kind < 0.5) {  // pavilion: a slab on posts over a bench
      const double height = random_.uniform(2.6, 3.4);
      builder_.add_prism(X_WR, rectangle({0, 0}, 2.0 * half), height, height + 0.25);
      for (const double x : {-1.0, 1.0}) {
        for (const double y : {-1.0, 1.0}) {
          const Vector3d post(x * (half.x() - 0.3), y * (half.y() - 0.3), 0.0);
          builder_.add_member(X_WR * post, X_WR * Vector3d(post.x(), post.y(), height + 0.1), 0.22);
        }
      }
      builder_.add_prism(X_WR, rectangle({0, 0}, half), 0.0, 0.6);
    } else if (kind < 0.65) {  // dome
      const double radius = half.minCoeff();
      builder_.add_prism(X_WR, regular_polygon(16, radius + 0.3), 0.0, 0.5);
      builder_.add_dome(X_WR * Eigen::Translation3d(0, 0, 0.4), {radius, radius, random_.uniform(0.5, 0.8) * radius},
                        -0.05, 16, 5);
    } else if (kind < 0.85) {  // planted box with a few stems
      builder_.add_prism(X_WR, rectangle({0, 0}, 2.0 * half, 0.4), 0.0, 0.7);
      for (int i = 0; i < 3; ++i) {
        const Vector3d foot{random_.uniform(-0.7, 0.7) * half.x(), random_.uniform(-0.7, 0.7) * half.y(), 0.6};
        const double height = random_.uniform(1.5, 2.5), crown = random_.uniform(0.5, 1.0);
        builder_.add_cylinder(X_WR * foot, X_WR * Vector3d(foot + Vector3d(0, 0, height)), 0.12, 6);
        builder_.add_dome(X_WR * Eigen::Translation3d(foot + Vector3d(0, 0, height + 0.6 * crown)),
                          {crown, crown, crown}, -0.7 * crown, 10, 4);
      }
    } else {  // machinery
      builder_.add_prism(X_WR, rectangle({0, 0}, 2.0 * half), 0.0, random_.uniform(1.6, 2.6));
      for (const double x : {-0.45, 0.45}) {
        const Vector3d foot(x * half.x(), 0.0, 1.0);
        builder_.add_cylinder(X_WR * foot, X_WR * Vector3d(foot.x(), 0.0, 3.2), 0.35 * half.minCoeff(), 12);
      }
    }
  }

  MeshBuilder& builder_;
  const PodiumPlan& plan_;
  RandomStream& random_;
  double storey_, arcade_, bay_, rise_;
};

}  // namespace

void add_podium(MeshBuilder& builder, const PodiumPlan& plan, RandomStream& random) {
  Podium(builder, plan, random).build();
}

}  // namespace skein::sim
