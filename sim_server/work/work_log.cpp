#include "sim_server/work/work_log.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim_server/flight/vehicle_faults.hpp"

namespace skein::sim {
namespace {

constexpr double kWaySpeed = 4.0, kWayDetour = 1.5;  ///< speed [m/s]; length of paths / straight lines
constexpr double kSpare_s = 10.0, kBegin_s = 15.0;
constexpr double kPoor = 0.5;        ///< share of the possible score: a worse picture leaves a point open
constexpr double kLeastShare = 0.1;  ///< least amount / share of the open work per minute
constexpr double kMinute_s = 60.0;
constexpr double kCorners = 0.02;  ///< share of all work that always remains
constexpr double kFewest = 2.0;    ///< in kLeastScore or kLeastMapped: less open work does not count

/// Assumed speed of a UAV on its paths [m/s].
double way_speed(const VehicleConfig& vehicle) { return std::min(kWaySpeed, vehicle.max_speed_mps); }

}  // namespace

WorkLog::WorkLog(const Scenario& scenario, const Simulation& simulation)
    : scenario_(scenario),
      simulation_(simulation),
      names_(scenario.uav_names()),
      places_(scenario, simulation.scene()),
      surface_(simulation.scene().points),
      earned_(scenario.fleet.size(), simulation.scene().points.size(), scenario.rules),
      delivered_(earned_),
      best_earned_(simulation.scene().points.size(), 0.0F),
      best_delivered_(best_earned_),
      tracks_(scenario.fleet.size()) {
  for (const UavIndex i : FirstUavs(scenario.fleet.size())) {
    Uav uav;
    for (const Workplace& place : places_.of(i)) {
      uav.all_score += place.q;
      uav.all_points += place.q > 0.0;
    }
    uav.mapped.assign(best_earned_.size(), false);
    uavs_.push_back(std::move(uav));
  }
}

void WorkLog::end_step(const std::function<bool(const std::string&)>& is_member) {
  const StepEvents& events = simulation_.events();
  for (const KeyFrameEvent& event : events.key_frames) add_key_frame(event);
  for (const CaptureEvent& event : events.captures) {
    if (event.report) add_capture(*event.report);
  }
  for (const Collision& collision : events.collisions) take_out(collision.uav);
  const auto seconds_over = static_cast<std::size_t>(simulation_.tick() / kTicksPerSecond);
  while (!tracks_.empty() && tracks_.front().open.size() < seconds_over) end_second(is_member);
}

void WorkLog::add_key_frame(const KeyFrameEvent& event) {
  const std::vector<bool> shown = surface_.shown_by(event.key_frame.points_W);
  const auto knows = [this](UavIndex uav, std::size_t point) { return uavs_[uav].mapped[point]; };
  for (std::size_t point = 0; point < shown.size(); ++point) {
    if (!shown[point]) continue;
    const bool known = knows(event.uav, point) ||
                       std::ranges::any_of(event.neighbours, [&](UavIndex mate) { return knows(mate, point); });
    if (!known) uavs_[event.uav].gains.mapped += 1.0;
    uavs_[event.uav].mapped[point] = true;
    for (const UavIndex mate : event.neighbours) uavs_[mate].mapped[point] = true;
  }
}

double WorkLog::add(const CaptureReport& report, ScoreTable& table, std::vector<float>& best) {
  double gain = 0.0;
  for (const TallyChange& change : table.add(report)) {
    gain += std::max(0.0F, change.now.q - best[change.point]);
    best[change.point] = change.now.q;
  }
  return gain;
}

void WorkLog::add_capture(const CaptureReport& report) {
  uavs_[report.uav].gains.score += add(report, earned_, best_earned_);
  captures_.emplace(std::pair(static_cast<std::size_t>(report.uav), report.capture), report);
}

void WorkLog::add_release(UavIndex uav, std::uint64_t capture) {
  const auto found = captures_.find({static_cast<std::size_t>(uav), capture});
  if (found == captures_.end()) return;
  uavs_[uav].gains.delivered += add(found->second, delivered_, best_delivered_);
  captures_.erase(found);
}

void WorkLog::take_out(UavIndex uav) {
  for (const TallyChange& change : earned_.collide(uav)) best_earned_[change.point] = change.now.q;
  for (const TallyChange& change : delivered_.collide(uav)) best_delivered_[change.point] = change.now.q;
}

void WorkLog::end_second(const std::function<bool(const std::string&)>& is_member) {
  const double now_s = seconds(simulation_.tick());
  const bool flying = simulation_.mission().phase() == Phase::flying;
  const auto conditions = vehicle_conditions(simulation_.faults(), names_, simulation_.tick());
  for (const UavIndex i : FirstUavs(uavs_.size())) {
    Uav& uav = uavs_[i];
    WorkTrack& track = tracks_[i];
    if (!flying || !simulation_.uav(i).alive || !is_member(names_[i])) {
      uav.ready_s.reset();
      uav.gains = {};
      track.open += WorkTrack::kAway;
      track.done.push_back(0.0);
      continue;
    }
    const Open open = open_for(i, conditions[i].camera_works, conditions[i].lidar_works);
    if (!uav.ready_s)
      uav.ready_s = now_s + kBegin_s + kWayDetour * open.nearest_m / way_speed(scenario_.fleet[i].vehicle);
    const auto [done, any] = weigh(uav, open);
    uav.gains = {};
    track.open += any && now_s > *uav.ready_s ? WorkTrack::kOpen : WorkTrack::kNothingOpen;
    track.done.push_back(std::round(1e4 * done) / 1e4);
  }
}

std::vector<bool> WorkLog::mapped_in_reach(UavIndex uav) const {
  std::vector<bool> mapped = uavs_[uav].mapped;
  for (const UavIndex mate : FirstUavs(uavs_.size())) {
    if (simulation_.open_links().at(node_of_uav(uav), node_of_uav(mate)) == 0) continue;
    for (std::size_t point = 0; point < mapped.size(); ++point) {
      if (uavs_[mate].mapped[point]) mapped[point] = true;
    }
  }
  return mapped;
}

WorkLog::Open WorkLog::open_for(UavIndex uav, bool camera_works, bool lidar_works) const {
  const bool maps = scenario_.fleet[uav].vehicle.lidar && lidar_works;
  const std::vector<bool> mapped = maps ? mapped_in_reach(uav) : std::vector<bool>();
  const auto places = places_.of(uav);
  const Vector3d& p_W = simulation_.uav(uav).state.p_WB;
  const double speed = way_speed(scenario_.fleet[uav].vehicle);
  const double reach_m = (simulation_.mission().remaining_s(simulation_.tick()) - kSpare_s) * speed / kWayDetour;
  Open open;
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t point = 0; point < places.size(); ++point) {
    const Workplace& place = places[point];
    if (place.q <= 0.0 || best_earned_[point] >= kPoor * place.q) continue;
    const double way_m = (place.p_W - p_W).norm();
    if (way_m + place.home_m > reach_m) continue;
    const bool unmapped = maps && !mapped[point];
    if (!camera_works && !unmapped) continue;
    if (camera_works) open.score += place.q - best_earned_[point];
    open.mapped += unmapped;
    nearest_m = std::min(nearest_m, way_m);
  }
  if (std::isfinite(nearest_m)) open.nearest_m = nearest_m;
  return open;
}

std::pair<double, bool> WorkLog::weigh(const Uav& uav, const Open& open) const {
  double able = 0.0, mappers = 0.0;
  for (const UavIndex i : FirstUavs(uavs_.size())) {
    if (!simulation_.uav(i).alive) continue;
    able += 1.0;
    mappers += scenario_.fleet[i].vehicle.lidar.has_value();
  }
  const double left_s = std::max(kMinute_s, simulation_.mission().remaining_s(simulation_.tick()));
  const double share = kLeastShare * kMinute_s / left_s;
  const double score = std::max(kLeastScore, share * open.score / std::max(1.0, able));
  const double mapped = std::max(kLeastMapped, share * open.mapped / std::max(1.0, mappers));
  const bool any = open.score >= std::max(kFewest * kLeastScore, kCorners * uav.all_score) ||
                   open.mapped >= std::max(kFewest * kLeastMapped, kCorners * uav.all_points);
  return {(uav.gains.score + uav.gains.delivered) / score + uav.gains.mapped / mapped, any};
}

}  // namespace skein::sim
