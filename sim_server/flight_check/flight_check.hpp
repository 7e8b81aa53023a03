// Whether a fleet flies such that it could still stop: asked of the true states and the true scene, with nothing of
// what UAVs know, plan or are made of. docs/flight-safety.md says what is asked and how it is counted.
// Frame W.   Units: SI.   Threads: one.
//
// A body is a sphere about Bo that holds boxes and rotors at every attitude. The ground does not count: it may be
// landed on. All distances are from surface to surface, below 0 inside, kMostM at most, and right to kToleranceM.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "core/scenario.hpp"
#include "results/tracking_table.hpp"
#include "sight/ray_scene.hpp"
#include "sim_server/flight_check/braking.hpp"

namespace skein::sim {

/// Radius of the sphere about Bo that holds the whole body [m].
double body_sphere_m(const VehicleConfig& vehicle);

/// One UAV at the end of an exchange.
struct CheckedUav {
  Vector3d p_W = Vector3d::Zero(), v_W = Vector3d::Zero();  ///< true
  bool present = false;                                     ///< it is not out
  bool flies = false;
  double delay_s = 0.0;                       ///< until what its software says takes effect
  std::optional<TrajectoryCommand> setpoint;  ///< of the exchange: where it should be by now
};

/// A braking body that touches something, and did not in the exchange before.
struct FlightFinding {
  Tick tick = 0;
  UavIndex uav = {};
  std::optional<UavIndex> with;     ///< nullopt: the structure
  Vector3d p_W = Vector3d::Zero();  ///< where the braking UAV is nearest to it
  double distance_m = 0.0;          ///< there; below 0
};

class FlightCheck {
 public:
  static constexpr double kBrakingShare = 0.7;  ///< of a vehicle's greatest acceleration; the rest is for corrections
  static constexpr double kMostM = 10.0, kToleranceM = 0.01;
  /// Set-points climb while motors are yet to start: so long after a UAV has left the ground it still catches up, and
  /// its distance from them says nothing of how it tracks.
  static constexpr double kCatchUpS = 5.0;
  static constexpr std::size_t kMostFindings = 20;

  /// What was found so far.
  struct Findings {
    std::uint64_t exchanges = 0;     ///< of UAVs that flew
    std::uint64_t braking_hits = 0;  ///< of these: the braking body touches the structure
    /// Pairs and exchanges in which two braking bodies touch when both brake at once; in which they do where each of
    /// them may be anywhere on its way.
    std::uint64_t braking_meets = 0, ways_meet = 0;
    double least_clearance_m = kMostM, least_braking_clearance_m = kMostM;  ///< now; until it stands
    double least_separation_m = kMostM, least_braking_separation_m = kMostM;
    std::vector<FlightFinding> first;  ///< kMostFindings at most
    results::TrackingTable tracking;   ///< but for kCatchUpS after each take-off
  };

  explicit FlightCheck(const Scenario& scenario);

  /// One exchange. @param uavs  the fleet.   @param rays  the scene's; always the same one.
  void add(Tick tick, const RayScene& rays, std::span<const CheckedUav> uavs);
  const Findings& findings() const { return findings_; }

 private:
  struct Body {
    std::string vehicle;
    double radius_m = 0.0, deceleration_mps2 = 1.0;
    Vector3d known_at_W = Vector3d::Zero();
    double known_room_m = 0.0;  ///< its centre's distance from the structure there, or less
    bool hits = false;          ///< in the last exchange
    Tick rests_at = 0;          ///< when it last did not fly
  };

  Braking braking_of(UavIndex uav, const CheckedUav& state) const;
  void check_structure(Tick tick, const RayScene& rays, UavIndex uav, const CheckedUav& state);
  void check_pair(Tick tick, UavIndex a, UavIndex b, std::span<const CheckedUav> uavs);
  void check_tracking(Tick tick, UavIndex uav, const CheckedUav& state);
  void tell(const FlightFinding& finding);

  std::vector<Body> bodies_;
  std::set<std::pair<UavIndex, UavIndex>> meeting_;  ///< in the last exchange
  Findings findings_;
};

}  // namespace skein::sim
