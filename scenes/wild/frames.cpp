#include <algorithm>
#include <cmath>
#include <vector>

#include "scenes/lattice.hpp"
#include "scenes/wild/shapes.hpp"

namespace skein::sim::wild {
namespace {

constexpr double kThinnest = 0.05;  ///< least thickness of members and cables

/// Columns and beams on a grid, with some floors and some diagonals.
void add_frame(MeshBuilder& builder, const Isometry3d& X_WS, const Vector3d& size, RandomStream& random) {
  const auto cells = [&](double length, double cell) { return std::clamp(static_cast<int>(length / cell), 1, 6); };
  const double cell = random.uniform(3.0, 7.0), column = random.uniform(0.12, 0.5), beam = random.uniform(0.08, 0.35);
  const double brace = random.uniform(kThinnest, 0.12);
  const Eigen::Vector3i count(cells(size.x(), cell), cells(size.y(), cell), cells(size.z(), cell));
  const auto node = [&](int x, int y, int z) {
    return Vector3d(X_WS * Vector3d((static_cast<double>(x) / count.x() - 0.5) * size.x(),
                                    (static_cast<double>(y) / count.y() - 0.5) * size.y(),
                                    z == 0 ? kSunk : size.z() * z / count.z()));
  };
  for (int x = 0; x <= count.x(); ++x) {
    for (int y = 0; y <= count.y(); ++y) {
      builder.add_member(node(x, y, 0), node(x, y, count.z()), column);
      for (int z = 1; z <= count.z(); ++z) {
        if (x < count.x()) builder.add_member(node(x, y, z), node(x + 1, y, z), beam);
        if (y < count.y()) builder.add_member(node(x, y, z), node(x, y + 1, z), beam);
        const bool outer = y == 0 || y == count.y();
        if (outer && x < count.x() && random.uniform() < 0.4)
          builder.add_member(node(x, y, z - 1), node(x + 1, y, z), brace);
      }
    }
  }
  for (int z = 1; z <= count.z(); ++z) {
    for (int x = 0; x < count.x(); ++x) {
      for (int y = 0; y < count.y(); ++y) {
        if (random.uniform() > 0.3) continue;
        const Vector3d middle = X_WS.inverse() * (0.5 * (node(x, y, z) + node(x + 1, y + 1, z)));
        builder.add_box(X_WS * Eigen::Translation3d(middle),
                        {0.96 * size.x() / count.x(), 0.96 * size.y() / count.y(), 0.2});
      }
    }
  }
}

/// A mast that narrows upwards, sometimes with an arm.
void add_mast(MeshBuilder& builder, const Isometry3d& X_WS, const Vector3d& size, RandomStream& random) {
  const int corners = random.uniform() < 0.4 ? 3 : 4;
  const double foot = 0.5 * size.head<2>().maxCoeff(), head = foot * random.uniform(0.2, 0.8);
  const LatticeStyle style{random.uniform(0.1, 0.3), random.uniform(kThinnest, 0.12), random.uniform() < 0.4};
  const Isometry3d X_WL = X_WS * Eigen::Translation3d(0, 0, kSunk);
  const int fields = std::clamp(static_cast<int>(size.z() / (foot + head)), 3, 20);
  add_lattice(builder,
              cross_sections(X_WL, regular_polygon(corners, foot), regular_polygon(corners, head), size.z(), fields),
              style);
  if (random.uniform() < 0.6) {
    const double length = random.uniform(0.3, 0.8) * size.z(), z = random.uniform(0.7, 0.95) * size.z();
    const Isometry3d X_WA = frame_along(X_WS * Vector3d(0, 0, z), X_WS * Vector3d(length, 0, z + 0.1 * length));
    add_lattice(builder,
                cross_sections(X_WA, regular_polygon(corners, 0.7 * head), regular_polygon(corners, 0.3), length,
                               std::clamp(static_cast<int>(length / (1.5 * head)), 3, 14)),
                style);
  }
}

/// A roof, level or slanted, on rows of columns, with blocks below it.
void add_roof(MeshBuilder& builder, const Isometry3d& X_WS, const Vector3d& size, RandomStream& random) {
  const double slant = random.uniform(-0.2, 0.2), thick = random.uniform(0.3, 1.0), column = random.uniform(0.15, 0.6);
  const Isometry3d X_WR =
      X_WS * Eigen::Translation3d(0, 0, size.z() - 0.5 * thick) * Eigen::AngleAxisd(slant, Vector3d::UnitY());
  builder.add_box(X_WR, {size.x(), size.y(), thick});
  const int rows = std::clamp(static_cast<int>(size.x() / random.uniform(5.0, 10.0)), 2, 6);
  for (int i = 0; i < rows; ++i) {
    for (const double side : {-0.42, 0.42}) {
      const double x = (static_cast<double>(i) / (rows - 1) - 0.5) * 0.9 * size.x();
      const double z = size.z() - 0.5 * thick - x * std::tan(slant);
      builder.add_cylinder(X_WS * Vector3d(x, side * size.y(), kSunk), X_WS * Vector3d(x, side * size.y(), z), column,
                           10);
    }
  }
  const int blocks = draw_count(random, 0, 3);
  for (int i = 0; i < blocks; ++i) {
    const Vector3d block(random.uniform(1.5, 0.3 * size.x() + 1.5), random.uniform(1.5, 0.3 * size.y() + 1.5),
                         random.uniform(0.1, 0.35) * size.z() + 0.5);
    builder.add_box(X_WS * Eigen::Translation3d(random.uniform(-0.3, 0.3) * size.x(),
                                                random.uniform(-0.3, 0.3) * size.y(), 0.5 * block.z() + kSunk),
                    block);
  }
}

/// A hull in its dock, with deck houses, a funnel and a mast.
void add_ship(MeshBuilder& builder, const Isometry3d& X_WS, const Vector3d& size, RandomStream& random) {
  const double hull = 0.45 * size.z(), bulge = random.uniform(0.6, 0.9), half = 0.5 * size.y();
  std::vector<Ring> rings;
  constexpr int kRings = 11;
  for (int i = 0; i < kRings; ++i) {
    const double along = 2.0 * i / (kRings - 1) - 1.0;
    const double wide = std::max(0.06, 1.0 - std::pow(std::abs(along), along > 0.0 ? 2.0 : 5.0)) * half;
    const double keel = 0.3 + 0.35 * hull * std::pow(std::abs(along), 4.0), deck = hull * (1.0 + 0.15 * along * along);
    Ring ring;  // counter-clockwise as seen from the bow
    for (const Vector2d& p :
         {Vector2d(-0.25 * wide, keel), Vector2d(0.25 * wide, keel), Vector2d(bulge * wide, 0.5 * (keel + deck)),
          Vector2d(wide, deck), Vector2d(-wide, deck), Vector2d(-bulge * wide, 0.5 * (keel + deck))}) {
      ring.push_back(X_WS * Vector3d(0.5 * size.x() * along, p.x(), p.y()));
    }
    rings.push_back(std::move(ring));
  }
  builder.add_loft(rings);
  const double house = random.uniform(-0.3, 0.1) * size.x();
  double z = hull - 0.2;
  const int decks = draw_count(random, 1, 4);
  for (int i = 0; i < decks; ++i) {
    const double height = (0.75 * size.z() - hull) / decks, scale = 1.0 - 0.15 * i;
    builder.add_box(X_WS * Eigen::Translation3d(house, 0, z + 0.5 * height),
                    {0.25 * size.x() * scale, 0.75 * size.y() * scale, height + 0.1});
    z += height;
  }
  builder.add_cylinder(X_WS * Vector3d(house - 0.05 * size.x(), 0, z - 0.3),
                       X_WS * Vector3d(house - 0.05 * size.x(), 0, 0.9 * size.z()), 0.12 * size.y(), 14);
  const double mast = random.uniform(0.2, 0.35) * size.x();
  add_lattice(builder,
              cross_sections(X_WS * Eigen::Translation3d(mast, 0, hull - 0.3), regular_polygon(4, 0.8),
                             regular_polygon(4, 0.3), size.z() - hull, 6),
              {0.12, kThinnest, false});
}

/// A deck on piers, sometimes with stays from pylons.
void add_bridge(MeshBuilder& builder, const Isometry3d& X_WS, const Vector3d& size, RandomStream& random) {
  const double deck = random.uniform(0.35, 0.6) * size.z(), thick = random.uniform(0.5, 1.2);
  const bool stayed = random.uniform() < 0.6;
  builder.add_box(X_WS * Eigen::Translation3d(0, 0, deck), {size.x(), size.y(), thick});
  const int piers = draw_count(random, 2, 4);
  for (int i = 0; i < piers; ++i) {
    const double x = (static_cast<double>(i) / (piers - 1) - 0.5) * (stayed ? 0.55 : 0.85) * size.x();
    const double top = stayed ? size.z() : deck;
    for (const double side : {-0.5, 0.5}) {
      const double y = side * (size.y() + 0.6);
      builder.add_box(X_WS * Eigen::Translation3d(x, y, 0.5 * (top + kSunk)), {1.2, 0.8, top - kSunk});
      for (int stay = 1; stayed && stay <= 4; ++stay) {
        for (const double way : {-1.0, 1.0}) {
          const double foot = std::clamp(x + way * 0.09 * stay * size.x(), -0.49 * size.x(), 0.49 * size.x());
          builder.add_member(X_WS * Vector3d(x, y, top - 0.6 * stay), X_WS * Vector3d(foot, side * size.y(), deck),
                             random.uniform(kThinnest, 0.12));
        }
      }
    }
  }
  add_railing(builder, X_WS * Vector3d(-0.5 * size.x(), 0.48 * size.y(), deck + 0.5 * thick - 0.02),
              X_WS * Vector3d(0.5 * size.x(), 0.48 * size.y(), deck + 0.5 * thick - 0.02), X_WS.linear().col(2));
}

}  // namespace

std::span<const Kind> open_kinds() {
  static const std::vector<Kind> kinds = {
      {"frame", &add_frame, {0.8, 0.6, 0.7}, {2.0, 1.2, 2.0}},   {"mast", &add_mast, {0.2, 0.2, 1.0}, {0.4, 0.4, 2.0}},
      {"roof", &add_roof, {1.2, 0.8, 0.4}, {2.5, 1.4, 0.9}},     {"ship", &add_ship, {3.0, 0.8, 1.0}, {5.0, 1.1, 1.6}},
      {"bridge", &add_bridge, {4.0, 0.5, 0.8}, {7.0, 0.9, 1.8}},
  };
  return kinds;
}

void add_tree(MeshBuilder& builder, const Vector2d& p_W, double height, RandomStream& random) {
  const double crown = random.uniform(0.5, 0.8) * height, radius = random.uniform(0.2, 0.45) * height;
  const Isometry3d X_WS = standing_at(p_W, 0.0);
  builder.add_cylinder(X_WS * Vector3d(0, 0, kSunk), X_WS * Vector3d(0, 0, height - 0.5 * crown),
                       random.uniform(0.1, 0.3), 7);
  builder.add_dome(X_WS * Eigen::Translation3d(0, 0, height - 0.5 * crown), {radius, radius, 0.5 * crown},
                   -0.45 * crown, 10, 6);
}

void add_cables(MeshBuilder& builder, const Vector2d& from_W, const Vector2d& to_W, double height,
                RandomStream& random) {
  constexpr int kPieces = 8;
  const Vector3d a(from_W.x(), from_W.y(), height), b(to_W.x(), to_W.y(), height * random.uniform(0.8, 1.0));
  for (const Vector3d& top : {a, b}) {
    builder.add_cylinder(Vector3d(top.x(), top.y(), kSunk), top + Vector3d(0, 0, 0.4), random.uniform(0.1, 0.2), 8);
  }
  const int cables = draw_count(random, 1, 3);
  for (int i = 0; i < cables; ++i) {
    const double thick = random.uniform(kThinnest, 0.1), sag = random.uniform(0.3, 1.5), below = 0.8 * i;
    const auto at = [&](int piece) {
      const double share = static_cast<double>(piece) / kPieces;
      return Vector3d(a + share * (b - a) - Vector3d(0, 0, below + 4.0 * sag * share * (1.0 - share)));
    };
    for (int piece = 0; piece < kPieces; ++piece) builder.add_member(at(piece), at(piece + 1), thick);
  }
}

void add_canopy(MeshBuilder& builder, const Isometry3d& X_WS, const Vector3d& size, RandomStream& random) {
  builder.add_box(X_WS * Eigen::Translation3d(0, 0, size.z()), {size.x(), size.y(), random.uniform(0.2, 0.6)});
  for (const double x : {-0.45, 0.45}) {
    for (const double y : {-0.45, 0.45}) {
      builder.add_cylinder(X_WS * Vector3d(x * size.x(), y * size.y(), kSunk),
                           X_WS * Vector3d(x * size.x(), y * size.y(), size.z()), 0.15, 8);
    }
  }
}

}  // namespace skein::sim::wild
