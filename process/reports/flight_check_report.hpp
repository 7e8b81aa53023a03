// sim_server's report of its flight check (docs/flight-safety.md): part of reports.hpp.
#pragma once

#include <array>

#include "process/reports/report_types.hpp"

namespace skein {

/// Quantiles of the distance [m] between UAVs and their setpoints; empty without samples.
struct TrackingReport {
  Number from_mps = {};  ///< only for setpoints of at least this speed; empty: for all
  Count samples = {};
  Number p50 = {}, p99 = {}, p9999 = {}, max = {};
};
void describe(auto& f, TrackingReport& tracking) {
  f.field("from_mps", tracking.from_mps);
  f.field("max", tracking.max);
  f.field("p50", tracking.p50);
  f.field("p99", tracking.p99);
  f.field("p9999", tracking.p9999);
  f.field("samples", tracking.samples);
}

/// A UAV whose braking trajectory collides with something.
struct FlightFindingReport {
  Number time_s = {};
  Text uav = {};
  Text with = {};                                      ///< "structure" or a UAV
  std::optional<std::array<double, 3>> position = {};  ///< of the UAV in W [m], at the least distance
  std::optional<double> distance_m = {};               ///< between the surfaces there; negative: they overlap
};
void describe(auto& f, FlightFindingReport& finding) {
  f.field("distance_m", finding.distance_m);
  f.field("position", finding.position);
  f.field("time_s", finding.time_s);
  f.field("uav", finding.uav);
  f.field("with", finding.with);
}

/// Whether UAVs could always stop without a collision. docs/flight-safety.md explains each figure. A negative distance
/// means that two surfaces overlap.
struct FlightCheckReport {
  Count exchanges = {};      ///< sum over all UAVs of the exchanges in flight
  Count braking_hits = {};   ///< exchanges in which the braking body would touch the structure
  Count braking_meets = {};  ///< pairs of bodies that would touch if both began to brake now
  Count ways_meet = {};      ///< pairs whose braking trajectories touch, at whatever times
  std::optional<double> least_clearance_m = {}, least_braking_clearance_m = {};
  std::optional<double> least_separation_m = {}, least_braking_separation_m = {};
  TrackingReport tracking_error_m = {};
  std::vector<TrackingReport> tracking_by_speed = {};
  std::vector<FlightFindingReport> first = {};
};
void describe(auto& f, FlightCheckReport& check) {
  f.field("braking_hits", check.braking_hits);
  f.field("braking_meets", check.braking_meets);
  f.field("exchanges", check.exchanges);
  f.field("first", check.first);
  f.field("least_braking_clearance_m", check.least_braking_clearance_m);
  f.field("least_braking_separation_m", check.least_braking_separation_m);
  f.field("least_clearance_m", check.least_clearance_m);
  f.field("least_separation_m", check.least_separation_m);
  f.field("tracking_by_speed", check.tracking_by_speed);
  f.field("tracking_error_m", check.tracking_error_m);
  f.field("ways_meet", check.ways_meet);
}

}  // namespace skein
