// A UAV's camera: which interest points one exposure shows and how well, judged on ground truth.
// Frames: W world, B body, C camera (x optical axis, y left, z up).   Units: SI, radians.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/scenario.hpp"
#include "core/scene.hpp"
#include "sight/ray_scene.hpp"

namespace skein::sim {

/// Whether the first thing on the way from a camera is the surface that the point lies on, within
/// Camera::kSurfaceTolerance before or behind it: Camera's own test.
/// @param own_uav  whose body does not hide; kNobody: every body does.
bool in_sight(const Vector3d& p_WC, const Vector3d& p_W, UavIndex own_uav, const RayScene& world);
/// The reference's test, for `rules.ray_ends_at_point`: the surface must be met before the ray's end at the point, by
/// single-precision arithmetic. Of free views of points on their triangles only some 45 % see them, by rounding alone.
bool in_sight_of_reference(const Vector3d& p_WC, const Vector3d& p_W, UavIndex own_uav, const RayScene& world);

using SightTest = bool (*)(const Vector3d& p_WC, const Vector3d& p_W, UavIndex own_uav, const RayScene& world);
/// Which of the two is the referee's.
inline SightTest sight_test(const RulesConfig& rules) {
  return rules.ray_ends_at_point ? in_sight_of_reference : in_sight;
}

/// One interest point in one capture.
struct Detection {
  std::uint32_t point = 0;  ///< index of the interest point
  double q_blur = 0.0, q_res = 0.0;
  double q_distance = 0.0;  ///< what q_res owes to the distance (core/camera_quality.hpp)
  double q = 0.0;           ///< q_blur * q_res, of this capture
  float best = 0.0F;        ///< best of this UAV so far, this capture included; single as the reference's
  bool improved = false;    ///< this capture raised `best`
};

struct Capture {
  Tick tick = 0;
  std::vector<Detection> detections;  ///< by point index
  bool improved() const;              ///< any of them
};

/// States that a camera's body would have at the same instant if one of the conditions were off.
struct OtherStates {
  std::optional<RigidBodyState> exact;  ///< it flies by an exact position; nullopt: it does
  std::optional<RigidBodyState> calm;   ///< there is no wind; nullopt: there is none
};

class Camera {
 public:
  /// @param points  interest points of the scene; must outlive the camera.
  /// @param uav     fleet index: whose body hides only with `rules.own_body_hides`.
  /// @param conditions  true exposure and vibration; what is drawn is keyed by (seed, uav, number of the picture).
  Camera(const CameraConfig& config, double desired_mm_per_pixel, const RulesConfig& rules,
         const std::vector<InterestPoint>& points, UavIndex uav, const CameraConditions& conditions = {},
         std::uint64_t seed = 0);

  /// @param conditions  for the pictures that follow.
  void change_conditions(const CameraConditions& conditions);

  /// Whether strictly more than the trigger interval has passed since the last capture (0.1 s: every 41 ticks).
  bool ready(Tick tick) const { return !last_ || tick - *last_ > interval_; }

  /// Takes a picture and keeps the best score of each point. A point counts when it is within the search radius, in the
  /// field of view, scores more than 0 and at least `rules.min_point_score`, and is in sight. Structure, ground and
  /// UAVs hide. With `rules.camera_blind_in_structure` it sees nothing while structure stands between the body's origin
  /// and the camera: then it is not where a camera could be.
  /// @param world  with the poses of all UAVs at this tick.
  /// @param other  what pictures from these states would show is kept apart, and changes nothing else.
  /// Not thread-safe; cameras of different UAVs may work in parallel.
  Capture capture(Tick tick, const RigidBodyState& body, const GimbalState& gimbal, const RayScene& world,
                  const OtherStates& other = {});

  std::uint64_t captures() const { return captures_; }
  /// Best score of each interest point so far, 0 when never seen.
  const std::vector<float>& best() const { return best_; }
  /// Which interest points were ever in the picture and in sight, whatever their quality.
  const std::vector<bool>& seen() const { return seen_; }

  /// Best score of each interest point that pictures from the other states would have had, where it was more than
  /// best() at that time, else 0; empty if there never was such a state.
  const std::vector<float>& best_if_exact() const { return best_if_exact_; }
  const std::vector<float>& best_if_calm() const { return best_if_calm_; }

  static constexpr double kSurfaceTolerance = 0.025;  ///< [m]

 private:
  /// Calls `judge(index, quality, in_sight)` for each point in the field of view and radius of a picture with the body
  /// in this state, by index. `quality` may be missing; `in_sight()` traces a ray.
  template <class Judge>
  void for_each_in_view(const RigidBodyState& body, const GimbalState& gimbal, const RayScene& world,
                        const Judge& judge) const;
  void imagine(const std::optional<RigidBodyState>& body, const GimbalState& gimbal, const RayScene& world,
               std::vector<float>& best_if) const;

  double rated_exposure_s_;  ///< of the vehicle's file
  CameraConfig config_;      ///< with the true exposure
  double vibration_ = 0.0;   ///< deviation of each component of the turn [rad/s]
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
};

}  // namespace skein::sim
