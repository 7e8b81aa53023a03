#include "scenes/spire.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/math/random_stream.hpp"
#include "scenes/lattice.hpp"
#include "scenes/mesh_builder.hpp"
#include "scenes/podium.hpp"
#include "scenes/surface_sampling.hpp"
#include "scenes/variation.hpp"

namespace skein::sim {
namespace {

constexpr std::size_t kSpirePoints = 4200;

/// One face of a tier: a plane wall, x to the right as seen from outside, y inwards, z up from the tier's floor.
struct Face {
  Isometry3d X_WF = Isometry3d::Identity();
  double length = 0.0;
};

/// The tower in its own frame T: origin on the ground, z up.
class Spire {
 public:
  Spire(MeshBuilder& builder, const Isometry3d& X_WT, double podium_height, RandomStream& random)
      : builder_(builder),
        X_WT_(X_WT),
        random_(random),
        floor_(podium_height),
        radius_(random.uniform(12.5, 15.5)),
        top_radius_(random.uniform(4.6, 6.0)),
        roof_(random.uniform(88.0, 94.0)),
        bend_(random.uniform(0.75, 1.5)),
        twist_(random.uniform() < 0.5 ? 0.0 : random.uniform(-0.14, 0.14)),
        tiers_(5 + static_cast<int>(random.uniform(0.0, 3.0))),
        corners_(4 + 2 * static_cast<int>(random.uniform(0.0, 3.0))),
        slender_(corners_ == 4 ? random.uniform(0.78, 1.0) : 1.0),
        belt_(random.uniform(6.0, 9.0)),
        fin_spacing_(random.uniform(2.6, 4.2)),
        fin_depth_(random.uniform(0.5, 1.0)),
        crown_(random.uniform(9.0, 13.0)),
        height_(random.uniform(117.0, 123.0)) {}

  double widest() const { return 1.1 * radius_ + 2.5; }

  /// @returns a box around each tier and one around the crown.
  std::vector<OrientedBox> build() {
    std::vector<OrientedBox> boxes;
    const auto close = [&](const std::string& name, std::size_t first, double turn) {
      const Matrix3d R_WO = X_WT_.linear() * Eigen::AngleAxisd(turn, Vector3d::UnitZ()).toRotationMatrix();
      boxes.push_back(enclosing_box(name, builder_.mesh(), first, R_WO, kBoxMargin));
    };
    std::vector<double> share{0.0};  // tops of the tiers, in proportion to the height; lower tiers are taller
    for (int i = 0; i < tiers_; ++i)
      share.push_back(share.back() + random_.uniform(0.8, 1.2) * (1.3 - 0.6 * i / tiers_));
    double foot = floor_ - 0.5;
    for (int i = 0; i < tiers_; ++i) {
      const std::size_t first = builder_.mesh().vertices.size();
      const double top = floor_ + (roof_ - floor_) * share[static_cast<std::size_t>(i) + 1] / share.back();
      add_tier(i, foot, top);
      close("tier_" + std::to_string(i + 1), first, twist_ * i);
      foot = top - 0.5;
    }
    const std::size_t first = builder_.mesh().vertices.size();
    add_crown();
    add_mast();
    close("crown", first, twist_ * (tiers_ - 1));
    return boxes;
  }

 private:
  double tier_radius(int tier) const {
    return radius_ + (top_radius_ - radius_) * std::pow(static_cast<double>(tier) / (tiers_ - 1), bend_);
  }

  /// Plan of a tier, with its walls moved out by `out`: a rectangle with its corners cut off, or a regular polygon.
  Polygon plan(double radius, double out) const {
    if (corners_ == 4) {
      const Vector2d size = 1.75 * radius * Vector2d(1.0, slender_);
      return rectangle({0, 0}, size + Vector2d::Constant(2.0 * out), 0.28 * radius + 0.6 * out);
    }
    const double phase = std::numbers::pi / corners_;
    return regular_polygon(corners_, radius + out / std::cos(phase), phase);
  }

  Isometry3d tier_frame(int tier) const {
    return X_WT_ * Isometry3d(Eigen::AngleAxisd(twist_ * tier, Vector3d::UnitZ()));
  }

  std::vector<Face> faces(int tier, double z) const {
    const Polygon polygon = plan(tier_radius(tier), 0.0);
    std::vector<Face> all;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vector2d& a = polygon[i];
      const Vector2d& b = polygon[(i + 1) % polygon.size()];
      const Vector2d middle = 0.5 * (a + b);
      Face face;
      face.length = (b - a).norm();
      const double heading = std::atan2((b - a).y(), (b - a).x());
      face.X_WF = tier_frame(tier) * Eigen::Translation3d(middle.x(), middle.y(), z) *
                  Eigen::AngleAxisd(heading, Vector3d::UnitZ());
      all.push_back(face);
    }
    return all;
  }

  void add_tier(int tier, double foot, double top) {
    const double radius = tier_radius(tier);
    const Isometry3d X_WL = tier_frame(tier);
    builder_.add_prism(X_WL, plan(radius, 0.0), foot, top);
    for (double z = foot + 4.0; z < top - 2.5; z += belt_) builder_.add_prism(X_WL, plan(radius, 0.3), z, z + 0.5);
    builder_.add_prism(X_WL, plan(radius, 0.7), top - 0.6, top);  // the cornice of the terrace
    const double height = top - foot;
    for (const Face& face : faces(tier, foot)) {
      add_fins(face, height);
      if (face.length > 5.0) add_balconies(face, height);
      builder_.add_box(face.X_WF * Eigen::Translation3d(0, -0.5, height + 0.5), {face.length + 0.4, 0.25, 1.1});
    }
  }

  void add_fins(const Face& face, double height) {
    const int gaps = std::max(1, static_cast<int>(std::lround(face.length / fin_spacing_)));
    for (int i = 0; i <= gaps; ++i) {
      const double x = (face.length - 0.5) * (static_cast<double>(i) / gaps - 0.5);
      const double over = gaps > 1 && i % 2 == 1 ? 1.8 : -1.0;  // every other fin rises past the terrace
      builder_.add_box(face.X_WF * Eigen::Translation3d(x, 0, 0.5 * (height + over + 0.8)),
                       {0.35, 2.0 * fin_depth_, height + over - 0.8});
    }
  }

  void add_balconies(const Face& face, double height) {
    const double storey = random_.uniform(4.5, 7.0), reach = fin_depth_ + random_.uniform(0.5, 1.3);
    for (double z = 3.0; z < height - 4.0; z += storey) {
      const double length = random_.uniform(0.25, 0.6) * face.length;
      const double x = random_.uniform(-0.5, 0.5) * (face.length - length - 1.0);
      builder_.add_box(face.X_WF * Eigen::Translation3d(x, 0, z), {length, 2.0 * reach, 0.3});
      builder_.add_box(face.X_WF * Eigen::Translation3d(x, -reach + 0.12, z + 0.6), {length, 0.24, 1.1});
      for (const double side : {-0.5, 0.5}) {
        builder_.add_box(face.X_WF * Eigen::Translation3d(x + side * (length - 0.2), -0.5 * reach, z + 0.55),
                         {0.2, reach, 1.0});
      }
    }
  }

  /// A needle, a stepped pyramid, or a dome; with blades around its foot.
  void add_crown() {
    const Isometry3d X_WL = tier_frame(tiers_ - 1);
    const double kind = random_.uniform(), radius = top_radius_ - 0.8, bulge = random_.uniform(1.3, 2.2);
    const auto ring = [&](double r, double z) {
      Ring corners;
      for (const Vector2d& p : plan(r, 0.0)) corners.push_back(X_WL * Vector3d(p.x(), p.y(), z));
      return corners;
    };
    std::vector<Ring> rings;
    constexpr int kLevels = 8;
    for (int i = 0; i <= kLevels; ++i) {
      const double up = static_cast<double>(i) / kLevels, z = roof_ - 0.4 + (crown_ + 0.4) * up;
      const double needle = std::pow(1.0 - up, bulge), dome = std::sqrt(std::max(0.0, 1.0 - up * up));
      const double step = 1.0 - up;
      if (kind >= 0.35 && kind < 0.7) {  // two rings a step
        rings.push_back(ring(0.9 + (radius - 0.9) * step, z));
        rings.push_back(ring(0.9 + (radius - 0.9) * std::max(0.0, step - 0.6 / kLevels), z + 0.35));
      } else {
        rings.push_back(ring(0.9 + (radius - 0.9) * (kind < 0.35 ? needle : dome), z));
      }
    }
    builder_.add_loft(rings);
    const double blade = random_.uniform(0.35, 0.75) * crown_;
    for (const Face& face : faces(tiers_ - 1, roof_ - 0.3)) {
      if (face.length < 2.0) continue;
      for (const double x : {-0.3, 0.0, 0.3}) {
        const double height = x == 0.0 ? blade : 0.75 * blade;
        builder_.add_box(face.X_WF * Eigen::Translation3d(x * face.length, 0.35, 0.5 * height), {0.3, 0.9, height});
      }
    }
  }

  /// Lattice, then a pole with a lamp on top.
  void add_mast() {
    const double foot = roof_ + crown_ - 0.6, pole = random_.uniform(3.0, 5.0), length = height_ - foot - pole;
    const Isometry3d X_WL = X_WT_ * Eigen::Translation3d(0, 0, foot);
    const int corners = random_.uniform() < 0.5 ? 3 : 4;
    const LatticeStyle style{0.14, random_.uniform(0.05, 0.08), random_.uniform() < 0.5};
    add_lattice(builder_,
                cross_sections(X_WL, regular_polygon(corners, random_.uniform(0.8, 1.0)), regular_polygon(corners, 0.4),
                               length, std::max(4, static_cast<int>(std::lround(length / 1.2)))),
                style);
    const auto axis = [&](double z) { return X_WT_ * Vector3d(0, 0, z); };
    for (double z = foot + random_.uniform(2.0, 4.0); z < height_ - pole; z += random_.uniform(3.0, 5.0)) {
      builder_.add_cylinder(axis(z), axis(z + 0.12), 1.5, 14);  // galleries for aerials
    }
    builder_.add_cylinder(axis(height_ - pole - 0.5), axis(height_ - 0.3), 0.16, 8);
    builder_.add_cylinder(axis(height_ - pole - 0.2), axis(height_ - pole), 0.7, 12);
    builder_.add_dome(X_WT_ * Eigen::Translation3d(0, 0, height_ - 0.4), {0.4, 0.4, 0.4}, -0.3, 12, 5);
  }

  MeshBuilder& builder_;
  Isometry3d X_WT_;
  RandomStream& random_;
  double floor_, radius_, top_radius_, roof_, bend_, twist_;
  int tiers_, corners_;
  double slender_, belt_, fin_spacing_, fin_depth_, crown_, height_;
};

}  // namespace

UnsampledScene make_spire(std::uint64_t scene_seed) {
  RandomStream site(scene_seed, "spire_site", 0);
  PodiumPlan plan;
  const Vector2d middle{36.0 + site.uniform(-2.0, 2.0), 48.0 + site.uniform(-1.0, 3.0)};
  plan.X_WP = standing_at(middle, site.uniform(-0.22, 0.22));
  plan.size = {site.uniform(54.0, 62.0), site.uniform(42.0, 48.0)};
  plan.height = site.uniform(8.0, 10.5);
  plan.tower = {site.uniform(-9.0, 9.0), site.uniform(-4.0, 4.0)};

  MeshBuilder builder;
  Scene scene;
  RandomStream random(scene_seed, "spire_tower", 0);
  Spire spire(builder, plan.X_WP * Isometry3d(Eigen::Translation3d(plan.tower.x(), plan.tower.y(), 0)), plan.height,
              random);
  plan.tower_radius = spire.widest();
  RandomStream below(scene_seed, "spire_podium", 0);
  add_podium(builder, plan, below);
  scene.boxes.push_back(enclosing_box("podium", builder.mesh(), 0, plan.X_WP.linear(), kBoxMargin));
  const std::vector<OrientedBox> tiers = spire.build();
  scene.boxes.insert(scene.boxes.end(), tiers.begin(), tiers.end());
  scene.mesh = builder.take();
  vary_boxes(scene, scene_seed);
  return {std::move(scene), kSpirePoints, scene_seed};
}

}  // namespace skein::sim
