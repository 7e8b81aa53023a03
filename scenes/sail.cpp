#include "scenes/sail.hpp"

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

constexpr std::size_t kSailPoints = 4000;

/// The shape of a sail. Frame S: origin on the ground below its middle, x across it, y out of its convex side, z up.
/// u in [-1, 1] runs across, from the mast to the free edge, v in [0, 1] up.
struct SailShape {
  double height = 100.0, foot_width = 50.0, top_width = 7.0;
  double narrowing = 2.0;                    ///< exponent: the larger, the higher up the sail keeps its width
  double camber = 9.0;                       ///< depth of the curve across, at the foot
  double belly = 6.0;                        ///< depth of the curve upwards
  double foot_depth = 5.0, top_depth = 1.4;  ///< thickness of the sheet
  double mirror = 1.0;                       ///< -1: the mast is on the other side

  double width(double v) const { return top_width + (foot_width - top_width) * (1.0 - std::pow(v, narrowing)); }
  double depth(double v) const { return std::lerp(foot_depth, top_depth, v); }

  /// @param off  distance from the middle of the sheet along y.
  Vector3d at(double u, double v, double off) const {
    const double lean = 0.08 * height * v * v;  // the mast leans a little over the sail
    const double x = -0.5 * foot_width + lean + 0.5 * (1.0 + u) * width(v);
    const double curve = camber * (1.0 - 0.75 * v) * (1.0 - u * u) + 4.0 * belly * v * (1.0 - v);
    return {mirror * x, curve - 0.4 * camber + off, height * v};
  }
  Vector3d convex_face(double u, double v, double off = 0.0) const { return at(u, v, 0.5 * depth(v) + off); }
  Vector3d concave_face(double u, double v, double off = 0.0) const { return at(u, v, -0.5 * depth(v) - off); }
};

SailShape draw_shape(RandomStream& random) {
  SailShape shape;
  shape.height = random.uniform(84.0, 116.0);
  shape.foot_width = random.uniform(40.0, 54.0);
  shape.top_width = random.uniform(6.0, 11.0);
  shape.narrowing = random.uniform(1.5, 2.6);
  shape.camber = random.uniform(6.0, 13.0);
  shape.belly = random.uniform(3.0, 9.0);
  shape.foot_depth = random.uniform(4.0, 6.5);
  shape.top_depth = random.uniform(1.2, 2.2);
  shape.mirror = random.uniform() < 0.5 ? -1.0 : 1.0;
  return shape;
}

class Sail {
 public:
  Sail(MeshBuilder& builder, const Isometry3d& X_WS, const SailShape& shape)
      : builder_(builder), X_WS_(X_WS), shape_(shape) {}

  void add_sheet() {
    constexpr int kRows = 30, kColumns = 20;
    std::vector<Ring> convex, concave;
    for (int row = 0; row <= kRows; ++row) {
      const double v = static_cast<double>(row) / kRows;
      convex.emplace_back();
      concave.emplace_back();
      for (int column = 0; column <= kColumns; ++column) {
        const double u = shape_.mirror * (1.0 - 2.0 * column / kColumns);
        convex.back().push_back(X_WS_ * sunk(shape_.convex_face(u, v)));
        concave.back().push_back(X_WS_ * sunk(shape_.concave_face(u, v)));
      }
    }
    builder_.add_sheet(convex, concave);
  }

  /// Balconies with parapets on the convex side, storey by storey.
  void add_terraces(RandomStream& random) {
    const double storey = random.uniform(6.0, 8.0);
    for (double z = 12.0; z < 0.93 * shape_.height; z += storey) {
      const double v = z / shape_.height, reach = random.uniform(1.0, 2.6);
      const double length = random.uniform(0.5, 1.5), start = random.uniform(-0.9, 0.9 - length);
      add_ledge(v, start, start + length, -0.3, reach, 0.0, 0.35);
      add_ledge(v, start, start + length, reach - 0.25, reach, 0.2, 1.3);
    }
  }

  /// Booms along the concave side at some distance, with struts to the sheet and diagonals between the booms.
  void add_frame(RandomStream& random) {
    const int booms = 2 + static_cast<int>(random.uniform(0.0, 2.0));
    const int bays = static_cast<int>(std::lround(shape_.height / random.uniform(8.0, 11.0)));
    const double off = random.uniform(3.5, 5.5), spread = random.uniform(0.55, 0.75);
    const auto boom_u = [&](int boom) { return spread * (2.0 * boom / (booms - 1) - 1.0); };
    const auto node = [&](int boom, int bay) { return shape_.concave_face(boom_u(boom), 0.94 * bay / bays, off); };
    for (int bay = 0; bay < bays; ++bay) {
      for (int boom = 0; boom < booms; ++boom) {
        cylinder(bay == 0 ? sunk(node(boom, 0)) : node(boom, bay), node(boom, bay + 1), 0.45, 10);
        member(node(boom, bay + 1), shape_.concave_face(boom_u(boom), 0.94 * (bay + 1) / bays, -0.2), 0.35);
      }
      for (int boom = 0; boom + 1 < booms; ++boom) {
        member(node(boom, bay + 1), node(boom + 1, bay + 1), 0.3);
        const bool rising = (bay + boom) % 2 == 0;
        member(node(boom, rising ? bay : bay + 1), node(boom + 1, rising ? bay + 1 : bay), 0.2);
      }
    }
  }

  /// A tube along the straight edge, up to a tip above the sail.
  void add_mast(double beyond) {
    constexpr int kPieces = 12;
    for (int i = 0; i < kPieces; ++i) {
      const double v0 = static_cast<double>(i) / kPieces, v1 = static_cast<double>(i + 1) / kPieces;
      const Vector3d foot = shape_.at(-1.0, v0, 0.0);
      cylinder(i == 0 ? sunk(foot) : foot, shape_.at(-1.0, v1, 0.0), 0.5 * shape_.depth(v0) + 0.3, 14);
    }
    const Vector3d top = shape_.at(-1.0, 1.0, 0.0), way = (top - shape_.at(-1.0, 0.96, 0.0)).normalized();
    cylinder(top, top + beyond * way, 0.45, 10);
  }

  /// A round platform that stands out from the convex side on a tapering foot.
  void add_pod(RandomStream& random) {
    const double v = random.uniform(0.45, 0.75), u = random.uniform(-0.4, 0.4), radius = random.uniform(5.0, 7.5);
    const Vector3d centre = shape_.convex_face(u, v, 0.55 * radius);
    const auto ring = [&](double r, double z, double inwards) {
      Ring points;
      for (const Vector2d& p : regular_polygon(22, r)) {
        points.push_back(X_WS_ * (centre + Vector3d(p.x(), p.y() - inwards, z)));
      }
      return points;
    };
    const Ring rings[] = {ring(0.25 * radius, -0.8 * radius, 0.45 * radius), ring(radius, -1.0, 0.0),
                          ring(radius, 0.2, 0.0)};
    builder_.add_loft(rings);
    const Ring cabin[] = {ring(0.5 * radius, 0.0, 0.2 * radius), ring(0.5 * radius, 2.6, 0.2 * radius)};
    builder_.add_loft(cabin);
  }

  const SailShape& shape() const { return shape_; }

 private:
  static Vector3d sunk(const Vector3d& p) { return p.z() > 0.0 ? p : Vector3d(p.x(), p.y(), kSunk); }

  void cylinder(const Vector3d& from, const Vector3d& to, double radius, int sides) {
    builder_.add_cylinder(X_WS_ * from, X_WS_ * to, radius, sides);
  }
  void member(const Vector3d& from, const Vector3d& to, double thickness) {
    builder_.add_member(X_WS_ * from, X_WS_ * to, thickness);
  }

  /// A band along the convex face from u0 to u1, between two distances from the face and two heights above v.
  void add_ledge(double v, double u0, double u1, double near, double far, double low, double high) {
    constexpr int kColumns = 12;
    const auto row = [&](double off, double rise) {
      Ring points;
      for (int i = 0; i <= kColumns; ++i) {
        const double share = static_cast<double>(i) / kColumns;
        const double u = std::lerp(u0, u1, shape_.mirror > 0.0 ? share : 1.0 - share);  // towards +x
        points.push_back(X_WS_ * (shape_.convex_face(u, v, off) + Vector3d(0, 0, rise)));
      }
      return points;
    };
    const Ring top[] = {row(near, high), row(far, high)}, bottom[] = {row(near, low), row(far, low)};
    builder_.add_sheet(top, bottom);
  }

  MeshBuilder& builder_;
  Isometry3d X_WS_;
  SailShape shape_;
};

/// Adds boxes one above the other around the vertices from `first_vertex` on; `heights` are their limits.
void add_stacked_boxes(std::vector<OrientedBox>& boxes, const TriangleMesh& mesh, std::size_t first_vertex,
                       const Matrix3d& R_WS, std::span<const double> heights) {
  constexpr double kReach = 5.0;  // edges from one box into the next are shorter than this, or almost vertical
  const char* names[] = {"sail_low", "sail_middle", "sail_high"};
  for (std::size_t i = 0; i + 1 < heights.size(); ++i) {
    TriangleMesh part;
    for (std::size_t v = first_vertex; v < mesh.vertices.size(); ++v) {
      const double z = mesh.vertices[v].z();
      if (z > heights[i] - kReach && z < heights[i + 1] + kReach) part.vertices.push_back(mesh.vertices[v]);
    }
    OrientedBox box = enclosing_box(names[i], part, 0, R_WS, kBoxMargin);
    const double bottom = std::max(heights[i], box.center.z() - 0.5 * box.size.z());
    const double top = std::min(heights[i + 1], box.center.z() + 0.5 * box.size.z());
    box.center.z() = 0.5 * (bottom + top);
    box.size.z() = top - bottom;
    boxes.push_back(box);
  }
}

void add_main_sail(MeshBuilder& builder, std::vector<OrientedBox>& boxes, const Isometry3d& X_WS,
                   std::uint64_t scene_seed) {
  RandomStream random(scene_seed, "sail_main", 0);
  const std::size_t first = builder.mesh().vertices.size();
  Sail sail(builder, X_WS, draw_shape(random));
  sail.add_sheet();
  sail.add_mast(random.uniform(6.0, 13.0));
  sail.add_terraces(random);
  sail.add_frame(random);
  sail.add_pod(random);
  const double height = sail.shape().height, beyond = 20.0;
  const double heights[] = {kSunk - kBoxMargin, height * random.uniform(0.28, 0.38), height * random.uniform(0.6, 0.72),
                            height + beyond};
  add_stacked_boxes(boxes, builder.mesh(), first, X_WS.linear(), heights);
}

/// Two low steps around the foot of the sail, with a canopy on posts.
OrientedBox add_podium(MeshBuilder& builder, const Isometry3d& X_WS, std::uint64_t scene_seed) {
  RandomStream random(scene_seed, "sail_podium", 0);
  const std::size_t first = builder.mesh().vertices.size();
  const Vector2d size{random.uniform(52.0, 60.0), random.uniform(18.0, 24.0)};
  const double low = random.uniform(3.5, 5.0), high = low + random.uniform(2.0, 4.0);
  builder.add_prism(X_WS, rectangle({0, 2}, size, 4.0), kSunk, low);
  builder.add_prism(X_WS, rectangle({0, 2}, 0.75 * size, 3.0), low - 0.1, high);
  const double x = random.uniform(-12.0, 12.0), length = random.uniform(12.0, 18.0), front = 2.0 + 0.5 * size.y();
  builder.add_box(X_WS * Eigen::Translation3d(x, front + 1.5, low - 0.6), {length, 7.0, 0.4});
  for (const double side : {-0.45, 0.45}) {
    builder.add_cylinder(X_WS * Vector3d(x + side * length, front + 4.2, kSunk),
                         X_WS * Vector3d(x + side * length, front + 4.2, low - 0.6), 0.25, 10);
  }
  return enclosing_box("podium", builder.mesh(), first, X_WS.linear(), kBoxMargin);
}

OrientedBox add_small_sail(MeshBuilder& builder, const Vector2d& p_W, std::uint64_t scene_seed) {
  RandomStream random(scene_seed, "sail_small", 0);
  SailShape shape = draw_shape(random);
  const double scale = random.uniform(0.2, 0.28);
  shape.height *= scale;
  shape.foot_width *= scale * 1.3;
  shape.top_width *= scale;
  shape.camber *= scale;
  shape.belly *= scale;
  shape.foot_depth = random.uniform(0.8, 1.2);
  shape.top_depth = 0.5;
  const Isometry3d X_WS = standing_at(p_W, random.uniform(-std::numbers::pi, std::numbers::pi));
  const std::size_t first = builder.mesh().vertices.size();
  Sail sail(builder, X_WS, shape);
  sail.add_sheet();
  sail.add_mast(random.uniform(1.5, 4.0));
  builder.add_prism(X_WS, regular_polygon(18, random.uniform(8.0, 10.0)), kSunk, 0.9);
  return enclosing_box("small_sail", builder.mesh(), first, X_WS.linear(), kBoxMargin);
}

}  // namespace

UnsampledScene make_sail(std::uint64_t scene_seed) {
  RandomStream random(scene_seed, "sail_site", 0);
  const Vector2d p_W{random.uniform(52.0, 60.0), random.uniform(2.0, 18.0)};
  const bool convex_side_first = random.uniform() < 0.5;  // towards the starts
  const double heading = random.uniform(-0.6, 0.6) + (convex_side_first ? 0.5 : -0.5) * std::numbers::pi;
  const Vector2d small_p_W{random.uniform(20.0, 34.0), random.uniform(-60.0, -50.0)};
  const Isometry3d X_WS = standing_at(p_W, heading);

  MeshBuilder builder;
  Scene scene;
  add_main_sail(builder, scene.boxes, X_WS, scene_seed);
  scene.boxes.push_back(add_podium(builder, X_WS, scene_seed));
  scene.boxes.push_back(add_small_sail(builder, small_p_W, scene_seed));
  scene.mesh = builder.take();
  vary_boxes(scene, scene_seed);
  return {std::move(scene), kSailPoints, scene_seed};
}

}  // namespace skein::sim
