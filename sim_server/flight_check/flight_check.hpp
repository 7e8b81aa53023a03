// Checks whether the UAVs of a fleet could stop at any time without a collision. The check uses the true states and the
// true scene, and nothing of what the UAVs know or plan. docs/flight-safety.md defines the checks and the counts.
// Frame W.   Units: SI.   Threads: one.
//
// A body is a sphere about Bo that contains boxes and rotors at every attitude. The ground is not an obstacle, because
// UAVs land on it. Distances are between surfaces, negative if bodies overlap, at most kMostM, and accurate to
// kToleranceM.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "core/scenario/scenario.hpp"
#include "results/tracking_table.hpp"
#include "sight/ray_scene.hpp"
#include "sim_server/flight_check/braking.hpp"

namespace skein::sim {

/// Radius of the sphere about Bo that contains the whole body [m].
double body_sphere_m(const VehicleConfig& vehicle);

/// One UAV at the end of an exchange.
struct CheckedUav {
  Vector3d p_W = Vector3d::Zero(), v_W = Vector3d::Zero();  ///< true
  bool present = false;                                     ///< the UAV is alive
  bool flies = false;
  double delay_s = 0.0;                       ///< until a command that its software sends takes effect
  std::optional<TrajectoryCommand> setpoint;  ///< setpoint of the exchange: where the UAV should be now
};

/// A braking body that touches something and did not touch it in the previous exchange.
struct FlightFinding {
  Tick tick = 0;
  UavIndex uav = {};
  std::optional<UavIndex> with;     ///< nullopt: the structure
  Vector3d p_W = Vector3d::Zero();  ///< where the braking UAV is nearest to the obstacle
  double distance_m = 0.0;          ///< at p_W; negative
};

class FlightCheck {
 public:
  static constexpr double kBrakingShare = 0.7;  ///< of a vehicle's maximum acceleration; the rest is for corrections
  static constexpr double kMostM = 10.0, kToleranceM = 0.01;
  /// Setpoints already climb before the motors start. For this time after takeoff a UAV still catches up with them,
  /// and its distance from them is not a measure of its tracking.
  static constexpr double kCatchUpS = 5.0;
  static constexpr std::size_t kMostFindings = 20;

  /// Results so far.
  struct Findings {
    std::uint64_t exchanges = 0;     ///< sum over UAVs of the exchanges in which they flew
    std::uint64_t braking_hits = 0;  ///< those of them in which the braking body touches the structure
    /// Sums over pairs of UAVs of the exchanges in which the two bodies touch: if both brake at the same time; and if
    /// each of them may be anywhere on its braking path.
    std::uint64_t braking_meets = 0, ways_meet = 0;
    double least_clearance_m = kMostM, least_braking_clearance_m = kMostM;  ///< now; while it brakes
    double least_separation_m = kMostM, least_braking_separation_m = kMostM;
    std::vector<FlightFinding> first;  ///< the first kMostFindings
    results::TrackingTable tracking;   ///< without the kCatchUpS after each takeoff
  };

  explicit FlightCheck(const Scenario& scenario);

  /// Checks one exchange. @param uavs  in fleet order.   @param rays  of the scene; the same one in every call.
  void add(Tick tick, const RayScene& rays, std::span<const CheckedUav> uavs);
  const Findings& findings() const { return findings_; }

 private:
  struct Body {
    std::string vehicle;
    double radius_m = 0.0, deceleration_mps2 = 1.0;
    Vector3d known_at_W = Vector3d::Zero();  ///< place for which known_room_m was computed
    double known_room_m = 0.0;               ///< lower bound of the centre's distance from the structure there
    bool hits = false;                       ///< whether it touched the structure in the last exchange
    Tick rests_at = 0;                       ///< last tick at which it did not fly
  };

  Braking braking_of(UavIndex uav, const CheckedUav& state) const;
  void check_structure(Tick tick, const RayScene& rays, UavIndex uav, const CheckedUav& state);
  void check_pair(Tick tick, UavIndex a, UavIndex b, std::span<const CheckedUav> uavs);
  void check_tracking(Tick tick, UavIndex uav, const CheckedUav& state);
  void tell(const FlightFinding& finding);

  std::vector<Body> bodies_;
  std::set<std::pair<UavIndex, UavIndex>> meeting_;  ///< pairs that touched in the last exchange
  Findings findings_;
};

}  // namespace skein::sim
