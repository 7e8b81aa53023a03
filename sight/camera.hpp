// A UAV's camera: which interest points one exposure shows, and with which quality, computed from ground truth.
// Frames: W world, B body, C camera (x optical axis, y left, z up).   Units: SI, radians.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/scenario/scenario.hpp"
#include "core/scenario/scene.hpp"
#include "sight/poor_pictures.hpp"
#include "sight/ray_scene.hpp"

namespace skein::sim {

/// Whether a camera has line of sight to a point on a surface: the first hit of the ray towards the point is at most
/// Camera::kSurfaceTolerance in front of the point or behind it. The default test of Camera.
/// @param own_uav  UAV whose body does not occlude; kNoUav: every body does.
bool in_sight(const Vector3d& p_WC, const Vector3d& p_W, UavIndex own_uav, const RayScene& world);
/// As in_sight(), but with the reference's test (`rules.ray_ends_at_point`): in single precision, the ray must hit the
/// surface before it ends at the point. So rounding decides: only some 45 % of the unobstructed views of points that
/// lie on their triangles pass.
bool in_sight_of_reference(const Vector3d& p_WC, const Vector3d& p_W, UavIndex own_uav, const RayScene& world);

using SightTest = bool (*)(const Vector3d& p_WC, const Vector3d& p_W, UavIndex own_uav, const RayScene& world);
/// The test that the rules select.
inline SightTest sight_test(const RulesConfig& rules) {
  return rules.ray_ends_at_point ? in_sight_of_reference : in_sight;
}

/// One interest point in one capture.
struct Detection {
  std::uint32_t point = 0;  ///< index of the interest point
  double q_blur = 0.0, q_res = 0.0;
  double q_distance = 0.0;  ///< the part of q_res that is due to the distance (core/scoring/camera_quality.hpp)
  double q = 0.0;           ///< q_blur * q_res, of this capture
  float best = 0.0F;        ///< best q of this UAV so far, with this capture; single precision, as in the reference
  bool improved = false;    ///< this capture raised `best`
};

struct Capture {
  Tick tick = 0;
  std::vector<Detection> detections;  ///< ascending by point index
  std::vector<PoorSight> poor = {};   ///< better than all before that did not count either; ascending by point index
  bool improved() const;              ///< whether any detection is `improved`
};

/// States that the camera's body would have at the same instant without one of the conditions of the flight.
struct OtherStates {
  std::optional<RigidBodyState> exact;  ///< if the UAV knew its position exactly; nullopt: it does
  std::optional<RigidBodyState> calm;   ///< if there were no wind; nullopt: there was none
};

class Camera {
 public:
  /// @param desired_mm_per_pixel  > 0.
  /// @param points  interest points of the scene; must outlive the camera.
  /// @param uav     fleet index of the UAV; its own body occludes only with `rules.own_body_hides`.
  /// @param conditions  true exposure time and vibration; random draws are keyed by (seed, uav, number of the picture).
  Camera(const CameraConfig& config, double desired_mm_per_pixel, const RulesConfig& rules,
         const std::vector<InterestPoint>& points, UavIndex uav, const CameraConditions& conditions = {},
         std::uint64_t seed = 0);

  /// Sets the conditions for the pictures that follow.
  void change_conditions(const CameraConditions& conditions);

  /// Whether strictly more than the trigger interval has passed since the last capture (0.1 s: every 41 ticks).
  bool ready(Tick tick) const { return !last_ || tick - *last_ > interval_; }

  /// Takes a picture and updates the best score of each point. A point counts if it is within the search radius and in
  /// the field of view, its score is more than 0 and at least `rules.min_point_score`, and the camera has line of sight
  /// to it. Structure, ground and UAVs occlude. With `rules.camera_blind_in_structure` the camera sees nothing while
  /// structure stands between the body's origin and the camera, since no camera could be at such a place.
  /// @param world  with the poses of all UAVs at this tick.
  /// @param other  pictures from these states affect best_if_exact() and best_if_calm() only.
  /// @param poor   of the fleet so far, to fill Capture::poor; null: it stays empty. Nothing else depends on it.
  /// Not thread-safe; cameras of different UAVs may work in parallel.
  Capture capture(Tick tick, const RigidBodyState& body, const GimbalState& gimbal, const RayScene& world,
                  const OtherStates& other = {}, const PoorPictures* poor = nullptr);

  std::uint64_t captures() const { return captures_; }
  /// Best score of each interest point so far; 0 if it never counted.
  const std::vector<float>& best() const { return best_; }
  /// By interest point: whether it was ever in the field of view with line of sight, even with too low a quality.
  const std::vector<bool>& seen() const { return seen_; }

  /// Best score that each interest point would have had in pictures from the other states, if it exceeded best() at
  /// that time, else 0. Empty if there never was such a state.
  const std::vector<float>& best_if_exact() const { return best_if_exact_; }
  const std::vector<float>& best_if_calm() const { return best_if_calm_; }

  static constexpr double kSurfaceTolerance = 0.025;  ///< between the first hit of a ray and the point [m]

 private:
  /// A picture with the body in some state: what its points are judged with.
  struct View;
  View view_of(const RigidBodyState& body, const GimbalState& gimbal, const Vector3d& shake_W) const;
  /// Updates `near_`, which then has all points within the search radius of these pictures.
  void find_near(const std::array<const View*, 3>& views);
  /// Calls `judge(index, quality, in_sight)`, in ascending order of index, for each point in the field of view and
  /// search radius of a picture. `quality` may be nullopt; `in_sight()` traces a ray, so it should be called last.
  template <class Judge>
  void for_each_in_view(const View& view, const RayScene& world, const Judge& judge);
  void imagine(const View& view, const RayScene& world, std::vector<float>& best_if);
  /// As the rules' sight_test(), but traces no ray if a triangle that blocked an earlier ray surely blocks this one.
  bool sees(std::uint32_t point, const Vector3d& p_WC, const Vector3d& p_W, const RayScene& world);

  double rated_exposure_s_;  ///< from the vehicle's file
  CameraConfig config_;      ///< with the true exposure time
  double vibration_ = 0.0;   ///< standard deviation of each component of the camera's angular velocity [rad/s]
  std::uint64_t seed_;
  double desired_mm_per_pixel_;
  RulesConfig rules_;
  const std::vector<InterestPoint>& points_;
  UavIndex uav_;
  Tick interval_;
  std::optional<Tick> last_;
  std::uint64_t captures_ = 0;
  std::vector<float> best_;
  std::vector<bool> seen_;
  std::vector<float> best_if_exact_, best_if_calm_;
  // The following affect only the computing time.
  std::vector<std::uint32_t> near_;      ///< ascending; points within the search radius of `near_centre_`, and more
  std::optional<Vector3d> near_centre_;  ///< where the camera was when `near_` was found
  std::vector<std::uint32_t> blockers_;  ///< by point: the triangle that blocked its last ray, or kNoTriangle
  std::uint32_t last_blocker_ = kNoTriangle;  ///< of any point
};

}  // namespace skein::sim
