#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/math/euler.hpp"
#include "scenes/wild/shapes.hpp"

namespace skein::sim::wild {
namespace {

/// A box between two corners of S.
void add_block(MeshBuilder& builder, const Isometry3d& X_WS, const Vector3d& low, const Vector3d& high) {
  builder.add_box(X_WS * Eigen::Translation3d(0.5 * (low + high)), high - low);
}

/// A wall of piers, with slots or windows between them, and sometimes an overhanging deck.
void add_slab(MeshBuilder& builder, const Isometry3d& X_WS, const Vector3d& size, RandomStream& random) {
  const int bays = std::max(2, static_cast<int>(size.x() / random.uniform(4.0, 9.0)));
  const double bay = size.x() / bays, pier = bay * random.uniform(0.3, 0.65), half = 0.5 * size.y();
  for (int i = 0; i <= bays; ++i) {
    const double x = -0.5 * size.x() + i * bay;
    add_block(builder, X_WS, {x - 0.5 * pier, -half, kSunk}, {x + 0.5 * pier, half, size.z()});
    if (i == bays) break;
    const double sill = random.uniform() < 0.5 ? 0.0 : random.uniform(0.1, 0.4) * size.z();
    const double lintel = random.uniform(0.5, 1.0) * size.z();
    const double from = x + 0.5 * pier - 0.05, to = x + bay - 0.5 * pier + 0.05;
    if (sill > 0.5) add_block(builder, X_WS, {from, -0.9 * half, kSunk}, {to, 0.9 * half, sill});
    if (lintel < size.z() - 0.5)
      add_block(builder, X_WS, {from, -0.9 * half, lintel}, {to, 0.9 * half, size.z() - 0.1});
  }
  if (random.uniform() < 0.6) {
    const double reach = random.uniform(0.5, 3.5), z = random.uniform(0.75, 1.0) * size.z();
    add_block(builder, X_WS, {-0.48 * size.x(), -half - reach, z - 0.5}, {0.48 * size.x(), half + 0.2 * reach, z});
  }
}

/// A tapered and twisted tower with belts, and sometimes a head that is wider than its neck.
void add_tower(MeshBuilder& builder, const Isometry3d& X_WS, const Vector3d& size, RandomStream& random) {
  const int corners = draw_count(random, 4, 9), rings = 7;
  const double taper = random.uniform(0.45, 1.0), twist = random.uniform(-0.6, 0.6);
  const auto ring_at = [&](double share, double wider) {
    Ring ring;
    for (const Vector2d& p : regular_polygon(corners, 0.5, twist * share + std::numbers::pi / corners)) {
      const double scale = (1.0 - (1.0 - taper) * share) * wider;
      ring.push_back(X_WS * Vector3d(p.x() * size.x() * scale, p.y() * size.y() * scale, size.z() * share));
    }
    return ring;
  };
  std::vector<Ring> shaft;
  for (int i = 0; i < rings; ++i)
    shaft.push_back(ring_at(static_cast<double>(i) / (rings - 1) - (i == 0 ? 0.01 : 0.0), 1.0));
  builder.add_loft(shaft);
  for (double share = random.uniform(0.1, 0.3); share < 0.85; share += random.uniform(0.12, 0.35)) {
    builder.add_loft(std::vector<Ring>{ring_at(share, 1.0 + random.uniform(0.06, 0.35)),
                                       ring_at(share + 0.5 / size.z(), 1.0 + random.uniform(0.06, 0.35))});
  }
  if (random.uniform() < 0.5) {
    const double wider = random.uniform(1.3, 1.9);
    builder.add_loft(std::vector<Ring>{ring_at(0.82, 1.02), ring_at(0.86, wider), ring_at(0.97, wider)});
  }
}

/// Tiers, each shifted and turned a little against the one below; upper tiers may be larger.
void add_stepped(MeshBuilder& builder, const Isometry3d& X_WS, const Vector3d& size, RandomStream& random) {
  const int tiers = draw_count(random, 2, 5);
  const bool upside_down = random.uniform() < 0.25;
  double foot = kSunk;
  for (int i = 0; i < tiers; ++i) {
    const double top = size.z() * (i + 1) / tiers, share = static_cast<double>(upside_down ? tiers - 1 - i : i) / tiers;
    const double scale = 1.0 - 0.7 * share;
    const Vector2d room = 0.5 * (1.0 - scale) * size.head<2>();
    const Vector2d middle(random.uniform(-0.7, 0.7) * room.x(), random.uniform(-0.7, 0.7) * room.y());
    const Isometry3d X_WT = X_WS * Eigen::Translation3d(middle.x(), middle.y(), 0.0) *
                            Eigen::AngleAxisd(random.uniform(-0.15, 0.15), Vector3d::UnitZ());
    const Vector2d plan = scale * size.head<2>();
    builder.add_prism(X_WT, rectangle({0, 0}, plan, random.uniform() < 0.3 ? 0.15 * plan.minCoeff() : 0.0), foot, top);
    foot = top - 0.3;
  }
}

/// A leaning block with belts: its top is shifted against its foot by up to a third of its height.
void add_leaning(MeshBuilder& builder, const Isometry3d& X_WS, const Vector3d& size, RandomStream& random) {
  const double lean = random.uniform(0.1, 0.33) * size.z(), taper = random.uniform(0.5, 1.0);
  const double heading = random.uniform(-std::numbers::pi, std::numbers::pi);
  const auto ring_at = [&](double share) {
    Ring ring;
    const double scale = 1.0 - (1.0 - taper) * share;
    for (const Vector2d& p : rectangle({0, 0}, scale * size.head<2>())) {
      const Vector2d aside = lean * (share - 0.5) * Vector2d(std::cos(heading), std::sin(heading));
      ring.push_back(X_WS * Vector3d(p.x() + aside.x(), p.y() + aside.y(), kSunk + (size.z() - kSunk) * share));
    }
    return ring;
  };
  builder.add_loft(std::vector<Ring>{ring_at(0.0), ring_at(0.5), ring_at(1.0)});
  for (double share = 0.2; share < 0.95; share += random.uniform(0.15, 0.3)) {
    Ring low = ring_at(share), high = ring_at(share + 0.4 / size.z());
    const Vector3d middle = 0.25 * (low[0] + low[1] + low[2] + low[3]);
    const double wider = random.uniform(1.05, 1.25);
    for (Ring* ring : {&low, &high}) {
      for (Vector3d& p : *ring) p.head<2>() = middle.head<2>() + wider * (p - middle).head<2>();
    }
    builder.add_loft(std::vector<Ring>{low, high});
  }
}

/// A vault that is open at both ends, sometimes with a partial wall across one end.
void add_shell(MeshBuilder& builder, const Isometry3d& X_WS, const Vector3d& size, RandomStream& random) {
  constexpr int kRows = 15, kColumns = 9;
  const double thick = random.uniform(0.15, 0.5), sag = random.uniform(-0.25, 0.25);
  const auto sheet = [&](double inwards) {
    std::vector<Ring> rows;
    for (int r = 0; r < kRows; ++r) {
      const double angle = std::numbers::pi * r / (kRows - 1);
      Ring row;
      for (int c = 0; c < kColumns; ++c) {
        const double along = 2.0 * c / (kColumns - 1) - 1.0, rise = 1.0 - sag + sag * along * along;
        row.push_back(X_WS * Vector3d(0.5 * size.x() * along, -(0.5 * size.y() - inwards) * std::cos(angle),
                                      kSunk + ((size.z() - kSunk) * rise - inwards) * std::sin(angle)));
      }
      rows.push_back(std::move(row));
    }
    return rows;
  };
  builder.add_sheet(sheet(0.0), sheet(thick));
  if (random.uniform() < 0.5) {  // a wall across one end, with a gate in the middle
    const double gate = 0.2 * size.y();
    for (const double side : {-1.0, 1.0}) {
      const double a = side * gate, b = side * 0.42 * size.y();
      add_block(builder, X_WS, {0.5 * size.x() - 0.8, std::min(a, b), kSunk},
                {0.5 * size.x() - 0.4, std::max(a, b), 0.4 * size.z()});
    }
  }
}

/// Tanks in a row, with pipes beside and between them, and a rack of pipes along one side.
void add_tanks(MeshBuilder& builder, const Isometry3d& X_WS, const Vector3d& size, RandomStream& random) {
  const int count = std::clamp(static_cast<int>(size.x() / size.y()), 1, 4);
  const double room = size.x() / count;
  std::vector<Vector3d> tops;
  for (int i = 0; i < count; ++i) {
    const double radius = 0.5 * std::min(room, size.y()) * random.uniform(0.55, 0.9);
    const double height = size.z() * random.uniform(0.55, 0.95), x = -0.5 * size.x() + (i + 0.5) * room;
    const Vector3d foot(x, random.uniform(-0.5, 0.5) * (size.y() - 2.0 * radius), 0.0);
    builder.add_cylinder(X_WS * (foot + Vector3d(0, 0, kSunk)), X_WS * (foot + Vector3d(0, 0, height)), radius, 20);
    builder.add_dome(X_WS * Eigen::Translation3d(foot + Vector3d(0, 0, height - 0.1)), {radius, radius, 0.3 * radius},
                     0.001, 20, 4);
    tops.push_back(foot + Vector3d(0, 0, height));
    const double pipe = random.uniform(0.08, 0.4), out = radius + pipe + random.uniform(0.1, 0.6);
    builder.add_cylinder(X_WS * (foot + Vector3d(0, out, kSunk)), X_WS * (foot + Vector3d(0, out, height + 1.0)), pipe,
                         8);
  }
  for (int i = 0; i + 1 < count; ++i) {
    const int pipes = draw_count(random, 1, 3);
    for (int p = 0; p < pipes; ++p) {
      const double z = random.uniform(0.15, 0.5) * size.z(), radius = random.uniform(0.05, 0.35);
      const Vector3d a(tops[static_cast<std::size_t>(i)].x(), tops[static_cast<std::size_t>(i)].y(), z);
      const Vector3d b(tops[static_cast<std::size_t>(i) + 1].x(), tops[static_cast<std::size_t>(i) + 1].y(), z);
      builder.add_cylinder(X_WS * a, X_WS * b, radius, 8);
    }
  }
  const int rack = draw_count(random, 1, 4);
  for (int p = 0; p < rack; ++p) {  // horizontal, along one side
    const double z = random.uniform(0.6, 4.0), radius = random.uniform(0.05, 0.3), y = 0.5 * size.y() + 0.5 + 0.7 * p;
    builder.add_cylinder(X_WS * Vector3d(-0.5 * size.x(), y, z), X_WS * Vector3d(0.5 * size.x(), y, z), radius, 8);
  }
}

}  // namespace

std::span<const Kind> solid_kinds() {
  static const std::vector<Kind> kinds = {
      {"slab", &add_slab, {2.0, 0.25, 0.8}, {4.0, 0.6, 2.0}},
      {"tower", &add_tower, {1.0, 0.8, 2.0}, {1.2, 1.2, 5.0}},
      {"stepped", &add_stepped, {1.0, 0.7, 0.6}, {2.0, 1.2, 1.8}},
      {"leaning", &add_leaning, {0.8, 0.8, 1.2}, {1.5, 1.2, 3.0}},
      {"shell", &add_shell, {1.2, 1.0, 0.5}, {2.2, 1.4, 0.9}},
      {"tanks", &add_tanks, {2.0, 0.8, 0.6}, {4.0, 1.2, 1.4}},
  };
  return kinds;
}

}  // namespace skein::sim::wild
