#include "bench/sensing/sites.hpp"

#include <cmath>
#include <numbers>

#include "core/math/euler.hpp"
#include "scenes/cranes.hpp"
#include "scenes/mesh_builder.hpp"

namespace skein::bench {
namespace {

constexpr double kMastM = 150.0, kMastRadiusM = 0.4, kGuyM = 0.05;
constexpr double kBesideM = 9.0;  // distance of the UAV from the mast

/// Adds guys in three directions, from three heights to one anchor each. The longest lie along the box's long edge.
void add_guys(sim::MeshBuilder& builder, const Vector3d& foot_W) {
  for (const double bearing : {0.5, 7.0 / 6.0, 11.0 / 6.0}) {
    const double angle = bearing * std::numbers::pi, reach = bearing == 0.5 ? 70.0 : 45.0;
    const Vector3d anchor = foot_W + reach * Vector3d(std::cos(angle), std::sin(angle), 0.0);
    builder.add_box(Isometry3d(Eigen::Translation3d(anchor)), {1.5, 1.5, 0.8});
    for (const double height : {50.0, 100.0, 145.0}) {
      builder.add_member(anchor, foot_W + height * Vector3d::UnitZ(), kGuyM);
    }
  }
}

OrientedBox box_named(const Scene& scene, const std::string& name) {
  for (const OrientedBox& box : scene.boxes) {
    if (box.name == name) return box;
  }
  throw std::runtime_error("the scene has no box " + name);
}

}  // namespace

Site loose_box() {
  const Vector3d foot_W(0.0, 60.0, 0.0), up = Vector3d::UnitZ();
  sim::MeshBuilder builder;
  builder.add_cylinder(foot_W + sim::kSunk * up, foot_W + kMastM * up, kMastRadiusM);
  for (const double height : {50.0, 100.0, 145.0}) {
    builder.add_box(Isometry3d(Eigen::Translation3d(foot_W + height * up)), {2.4, 2.4, 0.3});
  }
  add_guys(builder, foot_W);
  Site site{.name = "loose box",
            .stem = "loose-box",
            .title = "A mast in a loose box",
            .route = "flight straight up beside it",
            .scene = {}};
  site.scene.mesh = builder.take();
  site.scene.boxes = {{.name = "all", .center = foot_W + 76.5 * up, .size = {85.0, 150.0, 153.0}}};
  site.start = (foot_W - kBesideM * Vector3d::UnitX()).head<2>();
  site.middle_W = foot_W;
  site.top_m = 66.0;
  return site;
}

/// The UAV flies under the girder, from one side to the other.
Site lattice() {
  Site site{.name = "lattice",
            .stem = "lattice",
            .title = "A gantry crane of lattice",
            .route = "level flight below its girder",
            .scene = {}};
  site.scene = sim::sampled(sim::make_cranes(0));
  const OrientedBox girder = box_named(site.scene, "gantry_girder");
  const Vector3d along_G = Vector3d(9.0, 20.0, 0.0).normalized();  // girder's frame: x along it, y along the rails
  site.along_W = (girder.R_WO * along_G).normalized();
  site.along_W.z() = 0.0;
  site.middle_W = {girder.center.x(), girder.center.y(), 0.0};
  site.start = (site.middle_W - 20.0 * site.along_W).head<2>();
  site.across_W = site.along_W;
  site.top_m = 40.0;
  return site;
}

}  // namespace skein::bench
