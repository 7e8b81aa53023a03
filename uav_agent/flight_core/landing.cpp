#include "uav_agent/flight_core/landing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "uav_agent/flight/site.hpp"
#include "uav_agent/flight_core/goal_ids.hpp"
#include "uav_agent/flight_core/landing_place.hpp"

namespace skein::agent {
namespace {

/// Between two landed UAVs, beyond the distance that the safety filter demands now. Chosen.
constexpr double kRoomM = 0.5;
constexpr double kBelowGroundM = 1.0;  ///< depth of the setpoint of a landed UAV; chosen, so that it stands firm
constexpr double kAboveSiteM = 0.6;    ///< tolerance, across and down, within which a UAV is above a site; chosen
constexpr double kRingsM[] = {4.0, 8.0, 12.0};  ///< radii about the place, where other sites are tried; chosen
constexpr int kRingHeadings = 8;                ///< sites tried on each ring; chosen
/// A UAV that has not sunk by kSinksM for kHeldS tries another site, at least kOtherSiteM from those that it tried.
/// Chosen.
constexpr double kSinksM = 0.3, kHeldS = 10.0, kOtherSiteM = 2.0;

double across_m(const Vector3d& a_W, const Vector3d& b_W) { return (a_W - b_W).head<2>().norm(); }

}  // namespace

double Landing::descent_s(double height_m, const FlightConfig& config) {
  const double slow_m = std::clamp(height_m, 0.0, kFromM);
  return std::max(0.0, height_m - kFromM) / config.climb_mps + slow_m / config.land_mps;
}

void Landing::begin(Steering& steering) {
  navigator_.stop(steering);
  navigator_.take_outcomes();
  descends_at_W_.reset();
  sites_W_.clear();
  held_above_W_.clear();
  double apart_m = 0.0;
  for (std::size_t uav = 0; uav < agent_.fleet.size(); ++uav) {
    if (uav == agent_.self) continue;
    apart_m = std::max(apart_m, filter_.apart_m(uav, config_.land_mps, Vector3d::UnitX()));
  }
  place_W_ = landing_place_W(agent_, apart_m + kRoomM);
  place_W_.z() = 0.0;
}

void Landing::step(const PlannerInput& in, bool must_sink, Steering& steering) {
  if (must_sink && !landed(in)) filter_.set_trust(SafetyFilter::Trust::all);
  if (descends_at_W_) {
    sink(in, must_sink, steering);
  } else {
    fly_to_site(in, must_sink, steering);
  }
}

void Landing::fly_to_site(const PlannerInput& in, bool must_sink, Steering& steering) {
  navigator_.step(in, filter_.held(), steering);
  std::optional<Vector3d> at_W;
  for (const Outcome& outcome : navigator_.take_outcomes()) {
    if (outcome.kind != Outcome::Kind::reached) continue;
    at_W = sites_W_.at(static_cast<std::size_t>(goal_ids::kSite - outcome.id));
  }
  if (across_m(in.state.p_WB, place_W_) < kAboveSiteM && !was_held_above(place_W_)) at_W = place_W_;
  if (must_sink && !at_W) at_W = in.tracking.setpoint.p_WB;
  if (at_W) {
    navigator_.stop(steering);
    navigator_.take_outcomes();
    begin_descent(*at_W, in, steering);
    return;
  }
  if (!navigator_.idle()) return;
  if (!sites_W_.empty() && !must_sink) {
    const bool may_trust_more = !navigator_.sees() && filter_.trust() == SafetyFilter::Trust::proved;
    if (may_trust_more) filter_.set_trust(SafetyFilter::Trust::unknown);
    // No site can be reached. The UAV lands while its charge still leaves time to try another place if it is held.
    const Vector3d& here_W = in.tracking.setpoint.p_WB;
    if (!may_trust_more && !was_held_above(here_W)) return begin_descent(here_W, in, steering);
  }
  find_sites(in);
  // A UAV gets back into the box in which it started only along the way by which it left it.
  const std::optional<Vector3d> out_W = filter_.way_out_W(in.boxes);
  std::vector<Goal> goals;
  for (std::size_t i = 0; i < sites_W_.size(); ++i) {
    const Vector3d above_W(sites_W_[i].x(), sites_W_[i].y(), kFromM);
    Goal goal{.id = goal_ids::kSite - static_cast<std::int64_t>(i), .way = {{above_W, config_.approach_mps}}};
    if (out_W && is_above_start(above_W, *out_W)) goal.way.insert(goal.way.begin(), {*out_W, config_.approach_mps});
    goals.push_back(std::move(goal));
  }
  navigator_.want(std::move(goals));
}

bool Landing::was_held_above(const Vector3d& site_W) const {
  return std::ranges::any_of(held_above_W_,
                             [&](const Vector3d& held_W) { return across_m(held_W, site_W) < kOtherSiteM; });
}

void Landing::find_sites(const PlannerInput& in) {
  sites_W_.clear();
  const auto add = [&](const Vector3d& site_W) {
    if (!was_held_above(site_W)) sites_W_.emplace_back(site_W.x(), site_W.y(), 0.0);
  };
  add(place_W_);
  add(agent_.me().p_WB_start);
  const FreeSpace space = navigator_.space(in);
  for (const double ring_m : kRingsM) {
    for (int i = 0; i < kRingHeadings; ++i) {
      const double heading = 2.0 * std::numbers::pi * i / kRingHeadings;
      const Vector3d site_W = place_W_ + ring_m * Vector3d(std::cos(heading), std::sin(heading), 0.0);
      if (space.free(site_W + Vector3d(0.0, 0.0, kFromM))) add(site_W);
    }
  }
  if (sites_W_.empty()) held_above_W_.clear();
}

void Landing::begin_descent(const Vector3d& place_W, const PlannerInput& in, Steering& steering) {
  descends_at_W_ = place_W;
  lowest_m_ = in.tracking.setpoint.p_WB.z();
  sank_at_ = in.tick;
  steering.motion = down_at(place_W, in);
}

void Landing::sink(const PlannerInput& in, bool must_sink, Steering& steering) {
  const Vector3d& setpoint_W = in.tracking.setpoint.p_WB;
  if (setpoint_W.z() < lowest_m_ - kSinksM) {
    lowest_m_ = setpoint_W.z();
    sank_at_ = in.tick;
  }
  if (landed(in)) return;
  const bool held = seconds(in.tick - sank_at_) > kHeldS;
  if (held && !must_sink && lowest_m_ > 0.0) {
    held_above_W_.push_back(*descends_at_W_);
    descends_at_W_.reset();
    return;
  }
  // The odometry of a landed UAV drifts. If the tracker then restarts at the drifted position, send the UAV down again.
  if (in.tracking.done || (held && must_sink)) begin_descent(held ? setpoint_W : *descends_at_W_, in, steering);
}

Path Landing::down_at(const Vector3d& place_W, const PlannerInput& in) const {
  Path path;
  const Vector3d at_W(place_W.x(), place_W.y(), 0.0);
  const Vector3d& setpoint_W = in.tracking.setpoint.p_WB;
  const bool beside = across_m(place_W, setpoint_W) > kAboveSiteM, above = setpoint_W.z() > kFromM + kAboveSiteM;
  if (in.state.p_WB.z() > kFromM && (beside || above)) {
    path.waypoints.push_back({at_W + Vector3d(0.0, 0.0, kFromM), config_.climb_mps});
  }
  path.waypoints.push_back({at_W - Vector3d(0.0, 0.0, kBelowGroundM), config_.land_mps});
  return path;
}

}  // namespace skein::agent
