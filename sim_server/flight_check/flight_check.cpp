#include "sim_server/flight_check/flight_check.hpp"

#include <algorithm>
#include <cmath>

#include "core/vehicle/airframe.hpp"

namespace skein::sim {
namespace {

constexpr double kNoPosition = 0.01;  ///< a setpoint this near to the origin means "no position": docs/rules.md
constexpr double kLookBeyondM = 2.0;  ///< extra search distance, so that the next exchanges need no search

}  // namespace

double body_sphere_m(const VehicleConfig& vehicle) {
  return std::max(box_reach(vehicle), std::hypot(vehicle.arm_m + vehicle.rotor_radius_m, vehicle.rotor_height_m));
}

FlightCheck::FlightCheck(const Scenario& scenario) {
  for (const UavConfig& uav : scenario.fleet) {
    bodies_.push_back({.vehicle = uav.vehicle.name,
                       .radius_m = body_sphere_m(uav.vehicle),
                       .deceleration_mps2 = kBrakingShare * uav.vehicle.max_acceleration_mps2});
  }
}

void FlightCheck::add(Tick tick, const RayScene& rays, std::span<const CheckedUav> uavs) {
  for (const UavIndex i : FirstUavs(uavs.size())) {
    if (!uavs[i].present) continue;
    if (uavs[i].flies) {
      ++findings_.exchanges;
      check_structure(tick, rays, i, uavs[i]);
      check_tracking(tick, i, uavs[i]);
    } else {
      bodies_[i].rests_at = tick;
      bodies_[i].hits = false;
    }
    for (const UavIndex j : FirstUavs(i)) {
      if (uavs[j].present && (uavs[i].flies || uavs[j].flies)) {
        check_pair(tick, j, i, uavs);
      } else {
        meeting_.erase({j, i});
      }
    }
  }
}

Braking FlightCheck::braking_of(UavIndex uav, const CheckedUav& state) const {
  return {.p_W = state.p_W,
          .v_W = state.flies ? state.v_W : Vector3d::Zero(),
          .delay_s = state.delay_s,
          .deceleration_mps2 = bodies_[uav].deceleration_mps2};
}

void FlightCheck::check_structure(Tick tick, const RayScene& rays, UavIndex uav, const CheckedUav& state) {
  Body& body = bodies_[uav];
  const Braking braking = braking_of(uav, state);
  const double way = braking.way_m();
  // Only distances below the least ones so far matter, and whether the body touches the structure.
  const double most_now = findings_.least_clearance_m + body.radius_m;
  const double most = std::max(findings_.least_braking_clearance_m, 0.0) + body.radius_m;
  const double reach = std::max(most_now, most + way);
  if (body.known_room_m - (state.p_W - body.known_at_W).norm() < reach) {
    body.known_room_m = std::min(rays.clearance(state.p_W, reach + kLookBeyondM), reach + kLookBeyondM);
    body.known_at_W = state.p_W;
    findings_.least_clearance_m = std::min(findings_.least_clearance_m, body.known_room_m - body.radius_m);
  }
  const bool hit_before = std::exchange(body.hits, false);
  if (body.known_room_m - (state.p_W - body.known_at_W).norm() >= most + way) return;

  const Vector3d direction = way > 0.0 ? state.v_W.normalized() : Vector3d::Zero();
  const auto clearance = [&](double s) {
    return std::min(rays.clearance(state.p_W + s * direction, most + way), most + way);
  };
  const Least least = least_along(clearance, way, 1.0, most, kToleranceM);
  const double distance = least.value - body.radius_m;
  findings_.least_braking_clearance_m = std::min(findings_.least_braking_clearance_m, distance);
  if (distance >= 0.0) return;
  body.hits = true;
  ++findings_.braking_hits;
  if (!hit_before) tell({tick, uav, std::nullopt, state.p_W + least.at * direction, distance});
}

void FlightCheck::check_pair(Tick tick, UavIndex a, UavIndex b, std::span<const CheckedUav> uavs) {
  const Braking of_a = braking_of(a, uavs[a]), of_b = braking_of(b, uavs[b]);
  const double radii = bodies_[a].radius_m + bodies_[b].radius_m, now = (of_a.p_W - of_b.p_W).norm();
  findings_.least_separation_m = std::min(findings_.least_separation_m, now - radii);
  const bool met_before = meeting_.erase({a, b}) > 0;
  const double most = std::max(findings_.least_braking_separation_m, 0.0) + radii;
  if (now - of_a.way_m() - of_b.way_m() >= most) return;

  if (distance_of_segments(of_a.p_W, of_a.end_W(), of_b.p_W, of_b.end_W()) < radii) ++findings_.ways_meet;
  const Least least = least_distance(of_a, of_b, most, kToleranceM);
  const double distance = least.value - radii;
  findings_.least_braking_separation_m = std::min(findings_.least_braking_separation_m, distance);
  if (distance >= 0.0) return;
  meeting_.insert({a, b});
  ++findings_.braking_meets;
  if (!met_before) tell({tick, a, b, of_a.at(least.at), distance});
}

void FlightCheck::check_tracking(Tick tick, UavIndex uav, const CheckedUav& state) {
  const auto& setpoint = state.setpoint;
  if (tick - bodies_[uav].rests_at <= ticks(kCatchUpS)) return;
  if (!setpoint || setpoint->p_WB.norm() < kNoPosition) return;
  findings_.tracking.add(bodies_[uav].vehicle, setpoint->v_WB.norm(), setpoint->a_WB.norm(),
                         (setpoint->p_WB - state.p_W).norm());
}

void FlightCheck::tell(const FlightFinding& finding) {
  if (findings_.first.size() < kMostFindings) findings_.first.push_back(finding);
}

}  // namespace skein::sim
