// Ray casting in the world: the first hit on a straight line, and the clearance from the structure. Uses Embree, and
// RayFan for many rays from one point.
// The world consists of the structure (triangles, double-sided), the ground plane z = 0, and the UAVs' bodies (boxes
// with rotor discs).   Frames: W world, B body.   Units: SI.
//
// The results are the same on every CPU. Embree uses one instruction set and one thread, and only determines which
// triangle a ray hits. The distance is computed here, in double precision: Embree divides by approximate reciprocals,
// whose last bits differ between CPU vendors. RayFan, too, only determines triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/scenario/scenario.hpp"
#include "core/scenario/scene.hpp"
#include "core/vehicle/airframe.hpp"
#include "sight/body_spheres.hpp"

namespace skein::sim {

/// The shape of a UAV for rays: its collision box, centred at the body's origin Bo; the boxes of its links; and six
/// flat rotor discs at the angles 30 + 60 i degrees. In B; [m].
struct BodyShape {
  Vector3d box_m = Vector3d::Zero();  ///< full edge lengths
  double arm_m = 0.0, rotor_radius_m = 0.0, rotor_height_m = 0.0;
  std::vector<BodyBox> links;
};
BodyShape body_shape(const VehicleConfig& vehicle);

inline constexpr UavIndex kNoUav{std::numeric_limits<std::size_t>::max()};
inline constexpr std::uint32_t kNoTriangle = std::numeric_limits<std::uint32_t>::max();

/// Selects the objects that a ray may hit besides the structure.
struct RayFilter {
  bool ground = true;
  bool uavs = true;
  /// UAVs that do not stop the ray: sensors and antennas sit inside or close to their own body.
  UavIndex except_uav = kNoUav, except_other_uav = kNoUav;
  /// If given, single rays are tested against these bodies only: for callers that know that they miss all others.
  /// scan() ignores it, and tests its rays against all bodies.
  std::optional<std::span<const UavIndex>> among = {};
};

enum class HitKind { structure, ground, uav };

struct Hit {
  double distance = 0.0;  ///< along the ray [m]
  HitKind kind = HitKind::structure;
  UavIndex uav = kNoUav;                 ///< fleet index, if `kind` is uav
  std::uint32_t triangle = kNoTriangle;  ///< index in the structure's mesh, if `kind` is structure
};

class RayScene {
 public:
  /// Builds the search tree: about 0.1 s per 100,000 triangles.
  /// @param mesh         structure; copied. May be empty.
  /// @param bodies       one per UAV, in fleet order; rays hit a body only after its first set_pose().
  /// @param native_cpu   let Embree choose the CPU's widest instruction set (faster; not the same bits everywhere).
  /// @throws std::runtime_error if a triangle has an invalid vertex index, or Embree fails (for example, no memory).
  explicit RayScene(const TriangleMesh& mesh, std::vector<BodyShape> bodies = {}, bool native_cpu = false);
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  /// Moves one UAV's body. Must not be called while another thread runs a query.
  void set_pose(UavIndex uav, const Isometry3d& X_WB);

  /// The first hit of a ray. All queries are const and safe from any number of threads.
  /// @param p_W  start [m].   @param direction_W  need not be a unit vector.   @param distance_max  from the start [m].
  /// @returns nullopt if the ray hits nothing up to `distance_max`, or `direction_W` is zero. A surface exactly at the
  ///          end may or may not count, so a ray to a surface point should be a little longer.
  std::optional<Hit> first_hit(const Vector3d& p_W, const Vector3d& direction_W, double distance_max,
                               const RayFilter& filter = {}) const;

  /// As first_hit(), but may return any hit of a body or the ground at a distance of less than `enough` [m], even if it
  /// is not the first. Cheaper, for callers that only ask whether a line is blocked.
  std::optional<Hit> first_hit_or_blocker(const Vector3d& p_W, const Vector3d& direction_W, double distance_max,
                                          double enough, const RayFilter& filter = {}) const;

  /// Bounding spheres of the bodies at their present poses, to find the bodies for RayFilter::among.
  const BodySpheres& body_spheres() const;

  /// Distance from `from_W` of the first hit on the segment to `to_W` [m]; nullopt if the segment is clear.
  std::optional<double> first_hit_distance(const Vector3d& from_W, const Vector3d& to_W,
                                           const RayFilter& filter = {}) const;

  /// The first hit *before* the end of a segment, in the single-precision arithmetic of the reference's rays: each
  /// triangle is tested in floats, and a hit counts only if its distance is less than the segment's length as a float.
  /// So if the segment ends on a surface, rounding decides whether that surface is hit. Slower than first_hit().
  /// @returns the hit's distance from `from_W` and the segment's length, both rounded to float; nullopt if there is no
  ///          hit before the end.
  struct HitBeforeEnd {
    float distance = 0.0F, length = 0.0F;
  };
  std::optional<HitBeforeEnd> first_hit_before_end(const Vector3d& from_W, const Vector3d& to_W,
                                                   const RayFilter& filter = {}) const;

  /// Whether a triangle of the structure certainly blocks a segment: the segment crosses it well inside its edges, at
  /// most `distance_max` from the start [m]. Then a ray along the segment hits this triangle or something nearer. Much
  /// cheaper than a ray, and usually sufficient: the triangle that blocked a view a moment ago mostly still blocks it.
  /// @param triangle  as in Hit; kNoTriangle blocks nothing.
  bool surely_blocked_by(std::uint32_t triangle, const Vector3d& from_W, const Vector3d& to_W,
                         double distance_max) const;

  /// Many rays from one point, for a LiDAR; uses RayFan instead of Embree.
  /// @param directions_W  unit vectors of a grid, row by row, as for RayFan::trace(); other lists are slower.
  /// @param columns       length of a row, >= 1; divides the number of directions.
  /// @param distance_max  > 0 [m].
  /// @param distances     one per direction; receives the distance of the first hit [m], infinity if there is none.
  /// @throws std::invalid_argument if the number of distances or `columns` does not match that of directions.
  void scan(const Vector3d& p_W, std::span<const Eigen::Vector3f> directions_W, std::size_t columns,
            double distance_max, const RayFilter& filter, std::span<double> distances) const;

  /// Distance of the closest point of the structure (not of ground or UAVs) [m].
  /// @returns infinity if the distance is not less than `distance_max`.
  double clearance(const Vector3d& p_W, double distance_max = std::numeric_limits<double>::infinity()) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace skein::sim
