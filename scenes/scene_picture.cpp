#include "scenes/scene_picture.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sight/ray_scene.hpp"

namespace skein::sim {
namespace {

constexpr int kWide = 560, kHigh = 480;  ///< of one view [pixels]
constexpr int kShades = 8;
constexpr double kAround = 6.0;  ///< margin around all objects [m]

/// A parallel projection.
class View {
 public:
  /// @param azimuth, elevation  of the viewer as seen from the scene [rad]; an elevation of pi/2 is a view from above.
  View(double azimuth, double elevation, const Eigen::AlignedBox3d& shown) {
    const Vector3d away(-std::cos(elevation) * std::cos(azimuth), -std::cos(elevation) * std::sin(azimuth),
                        -std::sin(elevation));
    right_ = Vector3d(-std::sin(azimuth), std::cos(azimuth), 0.0);
    into_ = away;
    up_ = right_.cross(into_);
    Eigen::AlignedBox2d seen;
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3d p = shown.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner));
      seen.extend(Vector2d(right_.dot(p), up_.dot(p)));
    }
    middle_ = seen.center();
    reach_ = 4.0 * shown.diagonal().norm();
    start_ = into_.dot(shown.center()) - 0.75 * reach_;
    scale_ = std::min(kWide / seen.sizes().x(), kHigh / seen.sizes().y());
  }

  /// Position of a point in the picture [pixels].
  Vector2d at(const Vector3d& p_W) const {
    return {0.5 * kWide + scale_ * (right_.dot(p_W) - middle_.x()),
            0.5 * kHigh - scale_ * (up_.dot(p_W) - middle_.y())};
  }
  /// Start of a pixel's ray, three diagonals in front of the middle of the scene: even rays to what is below the ground
  /// start above it. The direction is into(), the length reach().
  Vector3d origin(int x, int y) const {
    return (middle_.x() + (x + 0.5 - 0.5 * kWide) / scale_) * right_ +
           (middle_.y() - (y + 0.5 - 0.5 * kHigh) / scale_) * up_ + start_ * into_;
  }
  const Vector3d& into() const { return into_; }
  double reach() const { return reach_; }  ///< [m]
  /// Pixels per metre, for lengths across the direction of view.
  double scale() const { return scale_; }

 private:
  Vector3d right_, up_, into_;
  Vector2d middle_;
  double scale_ = 1.0;
  double start_ = 0.0, reach_ = 0.0;  ///< of a ray: its start along into_, and its length [m]
};

Eigen::AlignedBox3d all_that_is_shown(const Scenario& scenario, const Scene& scene) {
  Eigen::AlignedBox3d shown(scenario.station_position);
  for (const auto& vertex : scene.mesh.vertices) shown.extend(vertex.cast<double>());
  for (const OrientedBox& box : scene.boxes) {
    const Vector3d half = box.R_WO.cwiseAbs() * (0.5 * box.size);
    shown.extend(Vector3d(box.center - half)).extend(Vector3d(box.center + half));
  }
  for (const UavConfig& uav : scenario.fleet) shown.extend(Vector3d(uav.start.x(), uav.start.y(), 0.0));
  shown.extend(Vector3d(shown.min() - Vector3d(kAround, kAround, 0.0)));
  shown.extend(Vector3d(shown.max() + Vector3d(kAround, kAround, 0.0)));
  return shown;
}

/// The structure as SVG: for each shade, runs of pixels, row by row. The light comes from above and from the side.
std::string surfaces(const View& view, const Scene& scene) {
  const RayScene world(scene.mesh);
  const Vector3d light = Vector3d(0.4, -0.55, 0.73).normalized();
  std::array<std::string, kShades> paths;
  for (int y = 0; y < kHigh; ++y) {
    int shade_before = -1, from = 0;
    const auto end_run = [&](int x) {
      if (shade_before >= 0)
        paths[static_cast<std::size_t>(shade_before)] += fmt::format("M{} {}h{}", from, y, x - from);
    };
    for (int x = 0; x < kWide; ++x) {
      const auto hit = world.first_hit(view.origin(x, y), view.into(), view.reach(), {.uavs = false});
      int shade = -1;
      if (hit && hit->kind == HitKind::structure) {
        const auto& t = scene.mesh.triangles[hit->triangle];
        const Vector3d a = scene.mesh.vertices[t[0]].cast<double>(), b = scene.mesh.vertices[t[1]].cast<double>(),
                       c = scene.mesh.vertices[t[2]].cast<double>();
        const double bright = std::abs((b - a).cross(c - a).normalized().dot(light));
        shade = std::min(kShades - 1, static_cast<int>(bright * kShades));
      }
      if (shade == shade_before) continue;
      end_run(x);
      shade_before = shade;
      from = x;
    }
    end_run(kWide);
  }
  std::string svg;
  for (int shade = 0; shade < kShades; ++shade) {
    const int grey = 90 + shade * 130 / (kShades - 1);
    svg += fmt::format("<path transform=\"translate(0 .5)\" stroke=\"rgb({0},{0},{1})\" d=\"{2}\"/>\n", grey, grey + 10,
                       paths[static_cast<std::size_t>(shade)]);
  }
  return svg;
}

std::string boxes_svg(const View& view, const Scene& scene) {
  std::string path;
  for (const OrientedBox& box : scene.boxes) {
    const auto corner = [&](unsigned i) {
      const Vector3d sign(i & 1U ? 0.5 : -0.5, i & 2U ? 0.5 : -0.5, i & 4U ? 0.5 : -0.5);
      return view.at(box.center + box.R_WO * sign.cwiseProduct(box.size));
    };
    for (unsigned i = 0; i < 8; ++i) {
      for (const unsigned bit : {1U, 2U, 4U}) {
        if (i & bit) continue;
        const Vector2d a = corner(i), b = corner(i | bit);
        path += fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", a.x(), a.y(), b.x(), b.y());
      }
    }
  }
  return "<path class=\"box\" d=\"" + path + "\"/>\n";
}

std::string fleet_svg(const View& view, const Scenario& scenario) {
  std::string svg;
  for (const UavConfig& uav : scenario.fleet) {
    const Vector2d at = view.at({uav.start.x(), uav.start.y(), 0.0});
    const bool explorer = uav.vehicle.role == Role::explorer;
    svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"{}\"><title>{}</title></circle>\n", at.x(),
                       at.y(), explorer ? "#1f5fbf" : "#d9741a", uav.name);
  }
  const Vector2d at = view.at(scenario.station_position);
  return svg + fmt::format("<path fill=\"#b3261e\" d=\"M{:.1f} {:.1f}l5 9h-10Z\"><title>station</title></path>\n",
                           at.x(), at.y() - 5.0);
}

/// A bar with its length. It is horizontal, and so not foreshortened in either view.
std::string scale_bar(const View& view) {
  double length_m = 1.0;
  for (const double more : {2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0}) {
    if (view.scale() * more <= 0.25 * kWide) length_m = more;
  }
  return fmt::format(
      "<path stroke=\"#333\" d=\"M12.5 {0}v6h{1:.1f}v-6\"/><text x=\"{2:.1f}\" y=\"{3}\">{4:g} m</text>\n", kHigh - 14,
      view.scale() * length_m, 20.0 + view.scale() * length_m, kHigh - 8, length_m);
}

}  // namespace

std::string scene_picture(const Scenario& scenario, const Scene& scene) {
  const Eigen::AlignedBox3d shown = all_that_is_shown(scenario, scene);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" fill=\"none\">\n"
      "<style>.box{{stroke:#2a7a3a;stroke-width:.8}}text{{font:12px sans-serif;fill:#333}}</style>\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>\n",
      2 * kWide, kHigh + 24);
  const double right_angle = 0.5 * std::numbers::pi;
  const std::array<View, 2> views = {View(-right_angle + 0.5, 0.45, shown), View(-right_angle, right_angle, shown)};
  for (std::size_t i = 0; i < views.size(); ++i) {
    svg += fmt::format("<g transform=\"translate({} 24)\">\n", kWide * i) + surfaces(views[i], scene) +
           boxes_svg(views[i], scene) + fleet_svg(views[i], scenario) + scale_bar(views[i]) + "</g>\n";
  }
  const auto counted = [](std::size_t number, const char* one, const char* many) {
    return fmt::format("{} {}", number, number == 1 ? one : many);
  };
  return svg + fmt::format(
                   "<text x=\"8\" y=\"16\">{}: {} (explorers blue, photographers orange), station red, {} (green), {}, "
                   "{:.0f} s, {:g} mm per pixel</text>\n</svg>\n",
                   scenario.name, counted(scenario.fleet.size(), "UAV", "UAVs"),
                   counted(scene.boxes.size(), "box", "boxes"),
                   counted(scene.points.size(), "interest point", "interest points"), scenario.duration_s,
                   scenario.desired_mm_per_pixel);
}

}  // namespace skein::sim
