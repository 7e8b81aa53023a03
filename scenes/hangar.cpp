#include "scenes/hangar.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/math/euler.hpp"
#include "core/math/random_stream.hpp"
#include "scenes/airliner.hpp"
#include "scenes/mesh_builder.hpp"
#include "scenes/surface_sampling.hpp"
#include "scenes/variation.hpp"

namespace skein::sim {
namespace {

constexpr std::size_t kHangarPoints = 3500;
constexpr double kApron = 11.0;             ///< least distance between the origin, near the starts, and the airliner
constexpr double kWall = 0.4, kRoof = 0.5;  ///< thicknesses [m]

/// The layout of the site. Frame H: origin on the ground in the middle of the hangar's mouth, x into the hangar.
struct HangarSite {
  AirlinerShape airliner;
  Isometry3d X_WH = Isometry3d::Identity(), X_WA = Isometry3d::Identity();
  bool nose_first = true;
  double inside = 0.0;  ///< [m]; how far the airliner reaches into the hangar
};

HangarSite draw_hangar_site(std::uint64_t scene_seed) {
  RandomStream random(scene_seed, "hangar_site", 0);
  HangarSite site;
  site.airliner = draw_airliner(random);
  site.nose_first = random.uniform() < 0.65;
  // The airliner stands in the mouth. The outer parts of its wings stay outside, because the doors are there.
  site.inside = site.nose_first ? random.uniform(20.0, 32.0) : random.uniform(13.0, 16.0);
  const double heading = random.uniform(-0.22, 0.22);
  const double mouth = site.airliner.length + 1.0 - site.inside + kApron + random.uniform(0.0, 5.0);
  const Vector2d ahead(std::cos(heading), std::sin(heading)), across(-ahead.y(), ahead.x());
  site.X_WH = standing_at(mouth * ahead + random.uniform(-3.0, 3.0) * across, heading);

  const double skew = random.uniform(-0.03, 0.03), offset = random.uniform(-2.0, 2.0);
  const double nose = site.nose_first ? site.inside : site.inside - site.airliner.length;
  const Isometry3d X_HA(Eigen::Translation3d(nose, offset, 0.0) *
                        Eigen::AngleAxisd((site.nose_first ? std::numbers::pi : 0.0) + skew, Vector3d::UnitZ()));
  site.X_WA = site.X_WH * X_HA;
  return site;
}

class Hangar {
 public:
  Hangar(MeshBuilder& builder, const HangarSite& site, RandomStream& random)
      : builder_(builder),
        site_(site),
        width_(random.uniform(84.0, 92.0)),
        depth_(std::max(site.inside + 9.0, random.uniform(36.0, 48.0))),
        eaves_(random.uniform(22.0, 23.5)),
        rise_(random.uniform(3.0, 5.0)) {}

  /// Walls, roof, and its supports.
  void add_shell(RandomStream& random) {
    for (const double side : {-1.0, 1.0}) {
      box({0.5 * depth_, side * 0.5 * width_, 0.5 * (eaves_ + kSunk)}, {depth_, kWall, eaves_ - kSunk});
    }
    add_gable(depth_ - kWall, kSunk);
    add_roof(random.uniform(0.8, 2.0));
    const int bays = static_cast<int>(std::lround(depth_ / random.uniform(7.0, 9.0)));
    for (int i = 1; i < bays; ++i) add_frame(depth_ * i / bays);
    if (random.uniform() < 0.6) {  // offices along one side
      const double side = random.uniform() < 0.5 ? -1.0 : 1.0, height = random.uniform(5.0, 9.0);
      const double breadth = random.uniform(6.0, 10.0), length = depth_ * random.uniform(0.5, 0.9);
      box({depth_ - 0.5 * length, side * 0.5 * (width_ + breadth), 0.5 * (height + kSunk)},
          {length, breadth, height - kSunk});
    }
  }

  OrientedBox add_front() {
    const std::size_t first = builder_.mesh().vertices.size();
    add_gable(0.0, lintel());
    box({0.3, 0, lintel() - 0.3}, {1.4, width_, 1.0});
    return enclosing_box("hangar_front", builder_.mesh(), first, site_.X_WH.linear(), kBoxMargin);
  }

  /// Open sliding doors: the leaves stand one in front of the other, each a little closer to the middle.
  /// @param side  of the mouth, +1 or -1.
  OrientedBox add_doors(double side, RandomStream& random) {
    const std::size_t first = builder_.mesh().vertices.size();
    const int leaves = 3 + static_cast<int>(random.uniform(0.0, 2.0));
    const double leaf = random.uniform(5.5, 6.5), step = random.uniform(0.3, 0.7), top = lintel() - 0.4;
    for (int i = 0; i < leaves; ++i) {
      const double x = -0.9 - 1.0 * i, y = side * (0.5 * width_ - 0.5 * leaf - step * i);
      box({x, y, 0.5 * (top + kSunk)}, {0.3, leaf, top - kSunk});
      for (double z = 3.0; z < top; z += 5.0) box({x, y, z}, {0.55, leaf - 0.4, 0.3});
    }
    return enclosing_box(side > 0.0 ? "left_doors" : "right_doors", builder_.mesh(), first, site_.X_WH.linear(),
                         kBoxMargin);
  }

  /// Mobile work platforms under the roof, on both sides of the airliner.
  void add_stands(RandomStream& random) {
    const int stands = 1 + static_cast<int>(random.uniform(0.0, 3.0));
    for (int i = 0; i < stands; ++i) {
      const double side = i % 2 == 0 ? 1.0 : -1.0, height = random.uniform(2.5, 4.5);
      const Vector2d size{random.uniform(4.0, 6.0), random.uniform(2.0, 2.6)};
      const Vector2d p{random.uniform(4.0, 10.0), side * random.uniform(20.0, 28.0)};
      box({p.x(), p.y(), height}, {size.x(), size.y(), 0.25});
      for (const double along : {-0.5, 0.5}) {
        for (const double across : {-0.5, 0.5}) {
          const Vector2d foot = p + (size - Vector2d::Constant(0.2)).cwiseProduct(Vector2d(along, across));
          member({foot.x(), foot.y(), kSunk}, {foot.x(), foot.y(), height + 1.1}, 0.14);
        }
        const double y = p.y() + along * (size.y() - 0.2), reach = 0.5 * size.x() - 0.1;
        member({p.x() - reach, y, height + 1.05}, {p.x() + reach, y, height + 1.05}, 0.1);
      }
    }
  }

 private:
  double lintel() const { return eaves_ - 0.9; }
  double arch(double y) const { return eaves_ + rise_ * (1.0 - 4.0 * y * y / (width_ * width_)); }

  void box(const Vector3d& center, const Vector3d& size) {
    builder_.add_box(site_.X_WH * Eigen::Translation3d(center), size);
  }
  void member(const Vector3d& from, const Vector3d& to, double thickness) {
    builder_.add_member(site_.X_WH * from, site_.X_WH * to, thickness);
  }

  /// The wall across the hangar at x, from the height `bottom` up to the roof.
  void add_gable(double x, double bottom) {
    constexpr int kSteps = 16;
    Polygon outline{{-0.5 * width_, bottom}, {0.5 * width_, bottom}};
    for (int i = 0; i <= kSteps; ++i) {
      const double y = width_ * (0.5 - static_cast<double>(i) / kSteps);
      outline.emplace_back(y, arch(y) + 0.5 * kRoof);
    }
    Isometry3d X_HL(Eigen::Translation3d(x, 0, 0));  // local x across, local y up
    X_HL.linear() << Vector3d::UnitY(), Vector3d::UnitZ(), Vector3d::UnitX();
    builder_.add_prism(site_.X_WH * X_HL, outline, 0.0, kWall);
  }

  void add_roof(double overhang) {
    constexpr int kSteps = 16;
    const double reach = 0.5 * width_ + 0.5;
    std::vector<Ring> top, bottom;
    for (int i = 0; i <= kSteps; ++i) {
      const double y = reach * (2.0 * i / kSteps - 1.0), z = arch(y);
      const auto row = [&](double height) {
        return Ring{site_.X_WH * Vector3d(-overhang, y, height), site_.X_WH * Vector3d(0.5 * depth_, y, height),
                    site_.X_WH * Vector3d(depth_ + 0.3, y, height)};
      };
      top.push_back(row(z + kRoof));
      bottom.push_back(row(z));
    }
    builder_.add_sheet(top, bottom);
  }

  /// Two columns and the truss between them, under the roof.
  void add_frame(double x) {
    constexpr int kPanels = 18;
    constexpr double kTruss = 2.0;
    const double reach = 0.5 * width_ - 0.7;
    for (const double side : {-1.0, 1.0}) {
      box({x, side * reach, 0.5 * (eaves_ + kSunk)}, {0.7, 0.7, eaves_ - kSunk});
    }
    const auto node = [&](int i, double below) {
      const double y = reach * (2.0 * i / kPanels - 1.0);
      return Vector3d(x, y, arch(y) - below);
    };
    for (int i = 0; i < kPanels; ++i) {
      member(node(i, 0.15), node(i + 1, 0.15), 0.3);
      member(node(i, kTruss), node(i + 1, kTruss), 0.3);
      const bool rising = i % 2 == 0;
      member(node(i, rising ? kTruss : 0.15), node(i + 1, rising ? 0.15 : kTruss), 0.16);
    }
  }

  MeshBuilder& builder_;
  const HangarSite& site_;
  double width_, depth_, eaves_, rise_;
};

}  // namespace

UnsampledScene make_hangar(std::uint64_t scene_seed) {
  const HangarSite site = draw_hangar_site(scene_seed);
  RandomStream random(scene_seed, "hangar_building", 0);
  MeshBuilder builder;
  Scene scene;
  scene.boxes = add_airliner(builder, site.X_WA, site.airliner, kBoxMargin);
  Hangar hangar(builder, site, random);
  hangar.add_shell(random);
  hangar.add_stands(random);
  scene.boxes.push_back(hangar.add_front());
  for (const double side : {-1.0, 1.0}) scene.boxes.push_back(hangar.add_doors(side, random));
  scene.mesh = builder.take();
  vary_boxes(scene, scene_seed);
  return {std::move(scene), kHangarPoints, scene_seed};
}

}  // namespace skein::sim
