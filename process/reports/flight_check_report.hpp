// What sim_server reports of its flight check (docs/flight-safety.md): part of reports.hpp.
#pragma once

#include <array>

#include "process/reports/report_types.hpp"

namespace skein {

/// Distances of UAVs from their set-points, in quantiles; empty of no samples.
struct TrackingReport {
  Number from_mps = {};  ///< of set-points from this speed on; empty: of all
  Count samples = {};
  Number p50 = {}, p99 = {}, p9999 = {}, max = {};
};
template <class Fields>
void describe(Fields& f, TrackingReport& tracking) {
  f.field("from_mps", tracking.from_mps);
  f.field("max", tracking.max);
  f.field("p50", tracking.p50);
  f.field("p99", tracking.p99);
  f.field("p9999", tracking.p9999);
  f.field("samples", tracking.samples);
}

/// A UAV that could not stop short of something.
struct FlightFindingReport {
  Number time_s = {};
  Text uav = {};
  Text with = {};                                      ///< "structure" or a UAV
  std::optional<std::array<double, 3>> position = {};  ///< of the UAV where it is nearest
  std::optional<double> distance_m = {};               ///< between the surfaces there; below 0
};
template <class Fields>
void describe(Fields& f, FlightFindingReport& finding) {
  f.field("distance_m", finding.distance_m);
  f.field("position", finding.position);
  f.field("time_s", finding.time_s);
  f.field("uav", finding.uav);
  f.field("with", finding.with);
}

/// Whether UAVs flew such that they could stop (docs/flight-safety.md). Distances may be below 0.
struct FlightCheckReport {
  Count exchanges = {};  ///< of UAVs that flew
  Count braking_hits = {}, braking_meets = {}, ways_meet = {};
  std::optional<double> least_clearance_m = {}, least_braking_clearance_m = {};
  std::optional<double> least_separation_m = {}, least_braking_separation_m = {};
  TrackingReport tracking_error_m = {};
  std::vector<TrackingReport> tracking_by_speed = {};
  std::vector<FlightFindingReport> first = {};
};
template <class Fields>
void describe(Fields& f, FlightCheckReport& check) {
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
