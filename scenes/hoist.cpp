#include "scenes/hoist.hpp"

#include <numbers>

namespace skein::sim {
namespace {

constexpr double kRope = 0.05, kSling = 0.05;

/// Slings from the hook to the corners of a load's top.
void add_slings(MeshBuilder& builder, const Isometry3d& X_WH, const Isometry3d& X_HL, const Vector3d& top) {
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      builder.add_member(X_WH.translation(), X_WH * X_HL * Vector3d(x * top.x(), y * top.y(), top.z()), kSling);
    }
  }
}

/// @param X_WH  frame of the hook.
void add_load(MeshBuilder& builder, const Isometry3d& X_WH, RandomStream& random) {
  const double kind = random.uniform(), turn = random.uniform(0.0, std::numbers::pi), below = random.uniform(2.4, 3.4);
  const Isometry3d X_HL = Eigen::Translation3d(0, 0, -below) * Eigen::AngleAxisd(turn, Vector3d::UnitZ());
  const Isometry3d X_WL = X_WH * X_HL;
  if (kind < 0.25) return;
  if (kind < 0.5) {  // container, with ribs on its sides
    const Vector3d size(random.uniform(4.5, 6.1), 2.44, 2.6);
    builder.add_box(X_WL * Eigen::Translation3d(0, 0, -0.5 * size.z()), size);
    for (double x = -0.5 * size.x() + 0.4; x < 0.5 * size.x(); x += 0.8) {
      builder.add_box(X_WL * Eigen::Translation3d(x, 0, -0.5 * size.z()), {0.25, size.y() + 0.12, size.z() - 0.3});
    }
    add_slings(builder, X_WH, X_HL, {0.48 * size.x(), 0.48 * size.y(), -0.05});
  } else if (kind < 0.75) {  // girders, side by side
    const double length = random.uniform(7.0, 11.0);
    const int girders = 2 + static_cast<int>(random.uniform(0.0, 3.0));
    for (int i = 0; i < girders; ++i) {
      const double y = 0.45 * (i - 0.5 * (girders - 1));
      builder.add_box(X_WL * Eigen::Translation3d(random.uniform(-0.4, 0.4), y, -0.3), {length, 0.08, 0.5});
      for (const double z : {-0.55, -0.05}) builder.add_box(X_WL * Eigen::Translation3d(0, y, z), {length, 0.3, 0.06});
    }
    for (const double x : {-0.3, 0.3}) {
      builder.add_box(X_WL * Eigen::Translation3d(x * length, 0, -0.6), {0.12, 0.45 * girders + 0.1, 0.06});
    }
    add_slings(builder, X_WH, X_HL, {0.3 * length, 0.2 * girders, -0.05});
  } else {  // bucket: a cylinder that ends in a cone
    const double radius = random.uniform(0.6, 0.9);
    const auto ring = [&](double r, double z) {
      Ring corners;
      for (const Vector2d& p : regular_polygon(12, r)) corners.push_back(X_WL * Vector3d(p.x(), p.y(), z));
      return corners;
    };
    const Ring rings[] = {ring(0.25, -2.4), ring(radius, -1.4), ring(radius, 0.0)};
    builder.add_loft(rings);
    add_slings(builder, X_WH, X_HL, {0.6 * radius, 0.6 * radius, -0.05});
  }
}

}  // namespace

void add_hoist(MeshBuilder& builder, const Isometry3d& X_WT, double drop, RandomStream& random) {
  for (const double x : {-0.4, 0.4}) {
    for (const double y : {-0.15, 0.15}) {
      builder.add_member(X_WT * Vector3d(x, y, 0.0), X_WT * Vector3d(x, y, -drop - 0.1), kRope);
    }
  }
  const auto at = [&](double x, double z) { return X_WT * Vector3d(x, 0.0, -drop + z); };
  builder.add_box(X_WT * Eigen::Translation3d(0, 0, -drop - 0.35), {1.2, 0.4, 0.7});
  builder.add_cylinder(at(0.0, -0.6), at(0.0, -1.1), 0.12, 8);
  const Vector3d bend[] = {at(0.0, -1.05), at(0.22, -1.25), at(0.14, -1.55), at(-0.12, -1.55), at(-0.22, -1.3)};
  for (std::size_t i = 0; i + 1 < std::size(bend); ++i) builder.add_member(bend[i], bend[i + 1], 0.12);
  add_load(builder, X_WT * Isometry3d(Eigen::Translation3d(0, 0, -drop - 1.5)), random);
}

}  // namespace skein::sim
