#include "scenes/towers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/math/euler.hpp"
#include "core/math/random_stream.hpp"
#include "scenes/mesh_builder.hpp"
#include "scenes/surface_sampling.hpp"
#include "scenes/variation.hpp"

namespace skein::sim {
namespace {

constexpr std::size_t kTowersPoints = 4000;
constexpr double kStripHeading = -0.3;  ///< of the row of starts, from east in W [rad]

/// The layout of the site, which is a strip along the row of the starts (core/scenario/scene_families.cpp).
struct TowersSite {
  double heading = 0.0;                      ///< of the deck, from east in W [rad]
  Isometry3d X_WD = Isometry3d::Identity();  ///< deck: origin on the ground below its middle, x along it
  double deck_length = 0.0, deck_width = 0.0, deck_bottom = 0.0, deck_height = 0.0;  // [m]; bottom: above the ground
};

/// A place on the strip, in W, by the distances along and across its axis [m].
Vector2d on_strip(double along, double across) {
  const Vector2d origin(0.0, 5.0);
  return origin + Eigen::Rotation2Dd(kStripHeading) * Vector2d(along, across);
}

TowersSite draw_towers_site(std::uint64_t scene_seed) {
  RandomStream random(scene_seed, "towers_site", 0);
  TowersSite site;
  site.heading = kStripHeading + random.uniform(-0.08, 0.08);
  const double along = 64.0 + random.uniform(-1.0, 1.0), across = 28.0 + random.uniform(-1.0, 1.5);
  site.X_WD = standing_at(on_strip(along, across), site.heading);
  site.deck_length = random.uniform(109.0, 119.0);
  site.deck_width = random.uniform(23.0, 26.0);
  site.deck_bottom = random.uniform(49.0, 51.0);
  site.deck_height = random.uniform(6.5, 7.5);
  return site;
}

// ---------------------------------------------------------------------------------------------------------- towers

/// A tower in its own frame T: origin on the ground, x along the long side, z up. It leans and tapers with height.
class Tower {
 public:
  Tower(MeshBuilder& builder, const Isometry3d& X_WT, double height, RandomStream& random)
      : builder_(builder),
        X_WT_(X_WT),
        height_(height),
        width_(random.uniform(23.0, 25.5)),
        depth_(random.uniform(14.0, 17.0)),
        lean_{random.uniform(-1.2, 1.2), random.uniform(-2.0, 2.0)},
        splay_(random.uniform(0.06, 0.14)),
        recess_(random.uniform(1.6, 2.4)),
        core_width_(random.uniform(4.0, 6.0)) {}

  void build(RandomStream& random) {
    const double wing = 0.5 * (width_ - core_width_);
    const double wing_x = 0.5 * (core_width_ + wing);
    add_part(rectangle({-wing_x, 0}, {wing, depth_}, 0.8), kSunk, height_);
    add_part(rectangle({wing_x, 0}, {wing, depth_}, 0.8), kSunk, height_);
    add_part(rectangle({0, 0}, {core_width_ + 1.0, depth_ - 2.0 * recess_}), kSunk, height_);
    for (const double side : {-1.0, 1.0}) {
      add_facade(side, -wing_x, wing, random);
      add_facade(side, wing_x, wing, random);
      add_end_fins(side, random);
    }
    add_part(rectangle({0, 0}, {width_ + 1.2, depth_ + 1.2}, 1.2), 0.42 * height_, 0.42 * height_ + 1.1);  // sky lobby
    add_part(rectangle({0, 0}, {width_ + 2.4, depth_ + 2.4}, 1.5), kSunk, random.uniform(3.5, 5.0));       // podium
  }

 private:
  /// A point of the plan at the height z: the tower is wider at the foot, and leans.
  Vector3d place(const Vector2d& plan, double z) const {
    const double up = std::clamp(z / height_, 0.0, 1.0);
    const double foot = 1.0 + splay_ * (1.0 - up) * (1.0 - up);
    const Vector2d p = plan.cwiseProduct(Vector2d(1.0, foot)) + lean_ * up * up;
    return X_WT_ * Vector3d(p.x(), p.y(), z);
  }

  void add_part(const Polygon& plan, double z0, double z1) {
    constexpr double kLevel = 6.0;
    const int levels = std::max(1, static_cast<int>(std::lround((z1 - z0) / kLevel)));
    std::vector<Ring> rings;
    for (int i = 0; i <= levels; ++i) {
      Ring ring;
      for (const Vector2d& p : plan) ring.push_back(place(p, z0 + (z1 - z0) * i / levels));
      rings.push_back(std::move(ring));
    }
    builder_.add_loft(rings);
  }

  /// Balconies between vertical ribs on the face y = side * depth / 2 of one wing.
  void add_facade(double side, double x, double wing, RandomStream& random) {
    const double face = side * 0.5 * depth_;
    const double rib_depth = random.uniform(0.7, 1.1);
    const int ribs = 3;
    for (int i = 0; i < ribs; ++i) {
      const double rib_x = x + (wing - 2.2) * (static_cast<double>(i) / (ribs - 1) - 0.5);
      add_part(rectangle({rib_x, face}, {0.5, 2.0 * rib_depth}), 6.0, height_ - 1.5);
    }
    const double storey = random.uniform(5.0, 6.5);
    for (double z = 8.0; z < height_ - 4.0; z += storey) {
      if (std::abs(z - 0.42 * height_) < 2.0) continue;  // the sky lobby is there
      const double reach = random.uniform(1.1, 1.8), length = random.uniform(0.45, 0.9) * (wing - 1.6);
      const double shift = random.uniform(-0.5, 0.5) * (wing - 1.6 - length);
      add_part(rectangle({x + shift, face}, {length, 2.0 * reach}), z, z + 0.35);
      const double parapet_y = face + side * (reach - 0.15);
      add_part(rectangle({x + shift, parapet_y}, {length, 0.3}), z + 0.2, z + 1.3);
    }
  }

  /// Vertical fins and a bay on a short side of the tower.
  void add_end_fins(double side, RandomStream& random) {
    const double face = side * 0.5 * width_;
    for (const double y : {-0.3, 0.3}) {
      add_part(rectangle({face, y * depth_}, {2.0 * random.uniform(0.6, 1.2), 0.6}), 6.0, height_ - 2.0);
    }
    const double bottom = random.uniform(10.0, 16.0), top = random.uniform(34.0, 42.0);
    add_part(rectangle({face, 0.0}, {2.0 * random.uniform(0.9, 1.5), 0.3 * depth_}, 0.4), bottom, top);
  }

  MeshBuilder& builder_;
  Isometry3d X_WT_;
  double height_, width_, depth_;
  Vector2d lean_;
  double splay_, recess_, core_width_;
};

OrientedBox add_tower(MeshBuilder& builder, const TowersSite& site, int number, std::uint64_t scene_seed) {
  RandomStream random(scene_seed, "towers_tower", static_cast<std::uint64_t>(number));
  const double along = 35.5 * (number - 1) + random.uniform(-1.0, 1.0);
  const double turn = random.uniform(-0.1, 0.1);
  const Vector2d foot = (site.X_WD * Vector3d(along, random.uniform(-1.0, 1.0), 0.0)).head<2>();
  const double height = site.deck_bottom + 1.5;  // its head is inside the deck
  const std::size_t first = builder.mesh().vertices.size();
  Tower(builder, standing_at(foot, site.heading + turn), height, random).build(random);
  return enclosing_box("tower_" + std::to_string(number + 1), builder.mesh(), first, rotation_z(site.heading + turn),
                       kBoxMargin);
}

// ------------------------------------------------------------------------------------------------------------ deck

/// The hull: cross-sections along a gentle bow, narrower towards both ends.
void add_hull(MeshBuilder& builder, const TowersSite& site, double bow) {
  constexpr int kSections = 30;
  const double bottom = site.deck_bottom, top = bottom + site.deck_height;
  std::vector<Ring> rings;
  for (int i = 0; i <= kSections; ++i) {
    const double t = 2.0 * i / kSections - 1.0;  // -1..1 along the deck
    const double w = 0.5 * (site.deck_width - bow) * (1.0 - 0.55 * std::pow(std::abs(t), 6.0));
    const double keel = bottom + 2.5 * std::pow(std::abs(t), 8.0);
    const double y = bow * (0.5 - t * t);
    const Vector2d section[] = {{-0.62 * w, keel}, {0.62 * w, keel}, {0.9 * w, bottom + 3.0}, {w, bottom + 4.5},
                                {w, top},          {-w, top},        {-w, bottom + 4.5},      {-0.9 * w, bottom + 3.0}};
    Ring ring;
    const double x = 0.5 * site.deck_length * t;
    for (const Vector2d& p : section) ring.push_back(site.X_WD * Vector3d(x, y + p.x(), p.y()));
    rings.push_back(std::move(ring));
  }
  builder.add_loft(rings);
}

void add_deck_relief(MeshBuilder& builder, const TowersSite& site, RandomStream& random) {
  const double top = site.deck_bottom + site.deck_height, half = 0.5 * site.deck_length;
  const auto box = [&](const Vector3d& center, const Vector3d& size) {
    builder.add_box(site.X_WD * Eigen::Translation3d(center), size);
  };
  for (double x = -half + 9.0; x < half - 8.0; x += random.uniform(5.0, 6.5)) {  // beams under the hull
    box({x, 0, site.deck_bottom + 0.1}, {0.5, 0.5 * site.deck_width, 1.4});
  }
  const double parapet = 0.5 * site.deck_width - 3.0;
  for (const double side : {-1.0, 1.0}) box({0, side * parapet, top + 0.5}, {1.4 * half, 0.4, 1.4});
  // Pavilions, a pool and lanterns on the roof, one after the other.
  double x = -0.8 * half;
  while (x < 0.75 * half) {
    const double length = random.uniform(7.0, 13.0), y = random.uniform(-2.5, 2.5);
    const double kind = random.uniform();
    if (kind < 0.45) {
      const double height = random.uniform(2.2, 3.8);
      box({x + 0.5 * length, y, top + 0.5 * height - 0.2}, {length, random.uniform(6.0, 9.0), height + 0.4});
      box({x + 0.5 * length, y, top + height + 0.3}, {length + 1.6, 10.5, 0.4});
    } else if (kind < 0.75) {
      const double radius = random.uniform(2.8, 4.2);
      builder.add_dome(site.X_WD * Eigen::Translation3d(x + 0.5 * length, y, top),
                       {radius, radius, random.uniform(2.5, 4.2)}, -0.3, 20, 6);
    } else {
      for (const double side : {-1.0, 1.0}) {
        box({x + 0.5 * length, y + 3.0 * side, top + 0.3}, {length, 0.5, 1.0});
        box({x + 0.5 * length * (1.0 + side) - 0.25 * side, y, top + 0.3}, {0.5, 6.5, 1.0});
      }
    }
    x += length + random.uniform(3.0, 6.0);
  }
}

OrientedBox add_deck(MeshBuilder& builder, const TowersSite& site, std::uint64_t scene_seed) {
  RandomStream random(scene_seed, "towers_deck", 0);
  const std::size_t first = builder.mesh().vertices.size();
  add_hull(builder, site, random.uniform(-3.0, 3.0));
  add_deck_relief(builder, site, random);
  return enclosing_box("deck", builder.mesh(), first, rotation_z(site.heading), kBoxMargin);
}

// ---------------------------------------------------------------------------------------------------------- museum

/// One petal: a curved leaf that rises outwards from the middle; its sections are flat ellipses.
void add_petal(MeshBuilder& builder, const Isometry3d& X_WM, double azimuth, double reach, double height) {
  constexpr int kSections = 9, kSides = 12;
  const Isometry3d X_WP = X_WM * Eigen::AngleAxisd(azimuth, Vector3d::UnitZ());
  const auto spine = [&](double t) {
    return Vector3d(2.5 + (reach - 2.5) * std::sin(1.25 * t) / std::sin(1.25), 0.0, 0.8 + (height - 0.8) * t * t);
  };
  std::vector<Ring> rings;
  for (int i = 0; i <= kSections; ++i) {
    const double t = static_cast<double>(i) / kSections;
    const Vector3d tangent = (spine(t + 0.01) - spine(t - 0.01)).normalized();
    const Vector3d across = Vector3d::UnitY(), out = across.cross(tangent);
    const double half_width = 1.6 + (0.3 * reach - 1.0) * std::sin(0.8 * std::numbers::pi * t);
    const double half_depth = 1.1 - 0.7 * t;
    Ring ring;
    for (const Vector2d& p : regular_polygon(kSides, 1.0)) {
      ring.push_back(X_WP * Vector3d(spine(t) + half_depth * p.x() * out + half_width * p.y() * across));
    }
    rings.push_back(std::move(ring));
  }
  builder.add_loft(rings);
}

OrientedBox add_museum(MeshBuilder& builder, std::uint64_t scene_seed) {
  RandomStream random(scene_seed, "towers_museum", 0);
  const Vector2d place{92.0 + random.uniform(-4.0, 4.0), -15.0 + random.uniform(-3.0, 3.0)};
  const Vector2d p_W = on_strip(place.x(), place.y());
  const Isometry3d X_WM = standing_at(p_W, random.uniform(-0.4, 0.4));
  const std::size_t first = builder.mesh().vertices.size();
  const int petals = 7 + static_cast<int>(random.uniform(0.0, 4.0));
  const double tallest = random.uniform(0.0, 2.0 * std::numbers::pi);
  for (int i = 0; i < petals; ++i) {
    const double azimuth = 2.0 * std::numbers::pi * (i + random.uniform(-0.12, 0.12)) / petals;
    const double rise = 0.5 + 0.5 * std::cos(azimuth - tallest);
    const double reach = random.uniform(10.0, 12.0) + 1.5 * rise, foot = random.uniform(6.0, 7.5);
    add_petal(builder, X_WM, azimuth, reach, foot + random.uniform(6.0, 7.5) * rise);
  }
  builder.add_prism(X_WM, regular_polygon(18, random.uniform(4.2, 5.2)), kSunk, 2.5);
  builder.add_dome(X_WM * Eigen::Translation3d(0, 0, 2.3), {4.0, 4.0, random.uniform(2.0, 3.0)}, -0.3);
  return enclosing_box("museum", builder.mesh(), first, X_WM.linear(), kBoxMargin);
}

// ----------------------------------------------------------------------------------------------------------- kiosk

OrientedBox add_kiosk(MeshBuilder& builder, std::uint64_t scene_seed) {
  RandomStream random(scene_seed, "towers_kiosk", 0);
  const Vector2d place{14.0 + random.uniform(-5.0, 5.0), -32.0 + random.uniform(-5.0, 5.0)};
  const Vector2d p_W = on_strip(place.x(), place.y());
  const Isometry3d X_WK = standing_at(p_W, random.uniform(-0.7, 0.7));
  const std::size_t first = builder.mesh().vertices.size();
  const Vector2d size{random.uniform(7.0, 9.5), random.uniform(5.5, 7.5)};
  const double height = random.uniform(4.0, 6.0);
  builder.add_prism(X_WK, rectangle({0, 0}, size), kSunk, height);
  builder.add_prism(X_WK, rectangle({0.8, 0}, size + Vector2d(3.0, 1.6)), height - 0.2, height + 0.3);  // canopy
  const double post_x = 0.5 * size.x() + 1.9;
  for (const double side : {-1.0, 1.0}) {
    const Vector3d foot(post_x, side * 0.45 * size.y(), kSunk);
    builder.add_member(X_WK * foot, X_WK * Vector3d(foot.x(), foot.y(), height), 0.3);
  }
  const Vector3d flue(-0.25 * size.x(), 0.2 * size.y(), height);
  builder.add_cylinder(X_WK * flue, X_WK * Vector3d(flue + Vector3d(0, 0, 2.0)), 0.6);
  return enclosing_box("kiosk", builder.mesh(), first, X_WK.linear(), kBoxMargin);
}

}  // namespace

UnsampledScene make_towers(std::uint64_t scene_seed) {
  const TowersSite site = draw_towers_site(scene_seed);
  MeshBuilder builder;
  Scene scene;
  scene.boxes.push_back(add_deck(builder, site, scene_seed));
  for (int i = 0; i < 3; ++i) scene.boxes.push_back(add_tower(builder, site, i, scene_seed));
  scene.boxes.push_back(add_museum(builder, scene_seed));
  scene.boxes.push_back(add_kiosk(builder, scene_seed));
  scene.mesh = builder.take();
  vary_boxes(scene, scene_seed);
  return {std::move(scene), kTowersPoints, scene_seed};
}

}  // namespace skein::sim
