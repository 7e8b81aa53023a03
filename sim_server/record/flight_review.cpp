#include "sim_server/record/flight_review.hpp"

namespace skein::sim {
namespace {

constexpr int kSpeeds = 8;  // intervals that begin at 0, 1, ... 7 m/s
constexpr double kSpeedStepMps = 1.0;

TrackingReport report_of(const results::TrackingTable::Quantiles& quantiles) {
  TrackingReport report{.samples = quantiles.samples};
  if (quantiles.samples == 0) return report;
  report.p50 = quantiles.p50;
  report.p99 = quantiles.p99;
  report.p9999 = quantiles.p9999;
  report.max = quantiles.max;
  return report;
}

}  // namespace

std::vector<CheckedUav> checked_uavs(const Simulation& simulation, double exchange_period_s) {
  std::vector<CheckedUav> uavs;
  for (const UavView& uav : simulation.uavs()) {
    uavs.push_back({.p_W = uav.state.p_WB,
                    .v_W = uav.state.v_WB,
                    .present = uav.alive,
                    .flies = uav.alive && uav.airborne,
                    .delay_s = exchange_period_s * (1 + uav.command_latency),
                    .setpoint = uav.setpoint});
  }
  return uavs;
}

void FlightReview::add_step(const Simulation& simulation) {
  if (simulation.mission().phase() != Phase::flying) return;
  check_.add(simulation.tick(), simulation.rays(), checked_uavs(simulation, scenario_.exchange_period_s));
}

FlightCheckReport FlightReview::report() const {
  const FlightCheck::Findings& found = check_.findings();
  FlightCheckReport report{.exchanges = found.exchanges,
                           .braking_hits = found.braking_hits,
                           .braking_meets = found.braking_meets,
                           .ways_meet = found.ways_meet,
                           .least_clearance_m = found.least_clearance_m,
                           .least_braking_clearance_m = found.least_braking_clearance_m,
                           .least_separation_m = found.least_separation_m,
                           .least_braking_separation_m = found.least_braking_separation_m,
                           .tracking_error_m = report_of(found.tracking.quantiles())};
  for (int k = 0; k < kSpeeds; ++k) {
    const double from = k * kSpeedStepMps, to = k + 1 < kSpeeds ? from + kSpeedStepMps : 1e9;
    TrackingReport row = report_of(found.tracking.quantiles(
        [&](const results::TrackingTable::Bin& bin) { return bin.speed_mps() >= from && bin.speed_mps() < to; }));
    row.from_mps = from;
    if (row.samples > 0U) report.tracking_by_speed.push_back(row);
  }
  for (const FlightFinding& finding : found.first) {
    const Vector3d& p = finding.p_W;
    report.first.push_back({.time_s = seconds(finding.tick),
                            .uav = scenario_.fleet[finding.uav].name,
                            .with = finding.with ? scenario_.fleet[*finding.with].name : "structure",
                            .position = {{p.x(), p.y(), p.z()}},
                            .distance_m = finding.distance_m});
  }
  return report;
}

}  // namespace skein::sim
