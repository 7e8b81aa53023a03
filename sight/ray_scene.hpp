// Rays through the world: what stands first on a straight line, and how far the structure is. Embree inside, and RayFan
// for many rays from one point.
// Structure (triangles, double-sided), ground plane z = 0 and the bodies of the UAVs (boxes with rotor discs).
// Frames: W world, B body.   Units: SI.
//
// Repeatable on every CPU: Embree is pinned to one instruction set and one thread, and it only names the triangle that
// a ray meets; the distance is computed here, in double precision, because Embree divides by approximate reciprocals
// whose last bits differ between makers of CPUs. RayFan, too, only names triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/scenario.hpp"
#include "core/scene.hpp"
#include "core/vehicle/airframe.hpp"
#include "sight/body_spheres.hpp"

namespace skein::sim {

/// What a ray meets of a UAV: its collision box about Bo, boxes of links and six flat rotor discs at 30 + 60 i degrees.
struct BodyShape {
  Vector3d box_m = Vector3d::Zero();  ///< full edge lengths
  double arm_m = 0.0, rotor_radius_m = 0.0, rotor_height_m = 0.0;
  std::vector<BodyBox> links;
};
BodyShape body_shape(const VehicleConfig& vehicle);

inline constexpr UavIndex kNobody{std::numeric_limits<std::size_t>::max()};
inline constexpr std::uint32_t kNoTriangle = std::numeric_limits<std::uint32_t>::max();

/// What a ray may meet besides the structure.
struct RayFilter {
  bool ground = true;
  bool uavs = true;
  /// UAVs that the ray passes through: sensors and antennas sit inside or close to their own body.
  UavIndex except_uav = kNobody, except_other_uav = kNobody;
  /// If given, no other bodies are looked at: for who knows that the ray passes the rest by.
  std::optional<std::span<const UavIndex>> among = {};
};

enum class HitKind { structure, ground, uav };

struct Hit {
  double distance = 0.0;  ///< along the ray [m]
  HitKind kind = HitKind::structure;
  UavIndex uav = kNobody;                ///< fleet index, when `kind` is uav
  std::uint32_t triangle = kNoTriangle;  ///< of the structure, when `kind` is structure
};

class RayScene {
 public:
  /// Builds the search tree: about 0.1 s per 100,000 triangles.
  /// @param mesh         structure; copied. May be empty.
  /// @param bodies       one per UAV in fleet order; they take part from their first set_pose() on.
  /// @param native_cpu   let Embree choose the CPU's widest instruction set (faster; not the same bits everywhere).
  /// @throws std::runtime_error when Embree refuses (a triangle that names a missing vertex, no memory).
  explicit RayScene(const TriangleMesh& mesh, std::vector<BodyShape> bodies = {}, bool native_cpu = false);
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  /// Moves one UAV's body. Not while another thread asks.
  void set_pose(UavIndex uav, const Isometry3d& X_WB);

  /// The first thing that a ray meets. All queries are const and safe from any number of threads.
  /// @param p_W  start [m].   @param direction_W  need not be a unit vector.   @param distance_max  from the start [m].
  /// @returns nullopt when nothing is met up to `distance_max`. A surface exactly at the end may or may not count:
  ///          who asks about a surface point overshoots it.
  std::optional<Hit> first_hit(const Vector3d& p_W, const Vector3d& direction_W, double distance_max,
                               const RayFilter& filter = {}) const;

  /// As first_hit(), but content with any body or the ground that it meets nearer than `enough`: what it returns then
  /// need not be the first. Cheaper, for who asks whether a way is blocked.
  std::optional<Hit> first_hit_or_blocker(const Vector3d& p_W, const Vector3d& direction_W, double distance_max,
                                          double enough, const RayFilter& filter = {}) const;

  /// The bodies as they stand, for RayFilter::among.
  const BodySpheres& body_spheres() const;

  /// Distance from `from_W` of the first thing on the segment to `to_W`; nullopt when the segment is clear.
  std::optional<double> first_hit_distance(const Vector3d& from_W, const Vector3d& to_W,
                                           const RayFilter& filter = {}) const;

  /// The first thing *before* the end of a segment, by the single-precision arithmetic of the reference's rays: each
  /// triangle is tested in floats, and what is not strictly nearer than the segment's length as a float is not met.
  /// So a surface that the segment ends on is met or not as its last bits have it. Slower than first_hit().
  /// @returns its distance from `from_W` and the segment's length, both as rounded; nullopt when nothing is before
  /// the end.
  struct HitBeforeEnd {
    float distance = 0.0F, length = 0.0F;
  };
  std::optional<HitBeforeEnd> first_hit_before_end(const Vector3d& from_W, const Vector3d& to_W,
                                                   const RayFilter& filter = {}) const;

  /// Whether a triangle of the structure surely blocks a segment: it is crossed well inside its edges, no farther than
  /// `distance_max` from the start. Then a ray along the segment meets something up to there, if not that triangle
  /// itself. Much cheaper than a ray: what blocked a view a moment ago mostly still does.
  /// @param triangle  as in Hit; kNoTriangle blocks nothing.
  bool surely_blocked_by(std::uint32_t triangle, const Vector3d& from_W, const Vector3d& to_W,
                         double distance_max) const;

  /// Many rays from one point, for a LiDAR; through RayFan instead of Embree.
  /// @param directions_W  unit vectors, row by row of a grid in which neighbours point to similar directions, each row
  ///                      and each column in one sense. Any list will do, at the price of speed.
  /// @param columns       length of a row, >= 1; divides the number of directions.
  /// @param distance_max  > 0.
  /// @param distances     as many as directions; receives the distance of the first hit, infinity where nothing is met.
  void scan(const Vector3d& p_W, std::span<const Eigen::Vector3f> directions_W, std::size_t columns,
            double distance_max, const RayFilter& filter, std::span<double> distances) const;

  /// Distance of the closest point of the structure (not of ground or UAVs) [m].
  /// @returns infinity when it is farther than `distance_max`.
  double clearance(const Vector3d& p_W, double distance_max = std::numeric_limits<double>::infinity()) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace skein::sim
