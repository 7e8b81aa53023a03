#include "bench/sensing/reach.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "bench/sensing/explorer.hpp"
#include "uav_agent/maps/world_mapper.hpp"

namespace skein::bench {
namespace {

constexpr double kHighM = 60.0;  // so high that the ground is out of the LiDAR's range
constexpr double kClimbMps = 4.0;
constexpr int kDirections = 72;
constexpr double kStepM = 0.25, kFarthestM = 40.0;
constexpr double kOneSweepS = 8.0, kThreeSweepsS = 24.0;
constexpr double kSettledS = 10.0, kAheadS = 20.0, kAskEachS = 0.5;  // of the straight flight after the hover

double free_way_m(const agent::WorldMap& map, const Vector3d& from_W, const Vector3d& along_W, double radius_m) {
  double way_m = 0.0;
  while (way_m < kFarthestM && map.tube_free(from_W + way_m * along_W, from_W + (way_m + kStepM) * along_W, radius_m)) {
    way_m += kStepM;
  }
  return way_m;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values.empty() ? 0.0 : values[values.size() / 2];
}

/// One flight with several maps, one for each width of the thinnest member that must not be missed.
class ReachFlight {
 public:
  ReachFlight(const std::vector<double>& member_widths_m, std::uint64_t seed)
      : scenario_(lone_explorer(Vector2d::Zero())),
        tube_m_(agent::body_radius_m(scenario_.fleet.front().vehicle) + agent::kHaloM),
        ahead_m_(member_widths_m.size()),
        explorer_(scenario_, Scene{}, seed,
                  std::make_unique<RoutePlanner>(
                      RoutePlanner::Config{
                          .height_m = kHighM, .climb_mps = kClimbMps, .hover_s = kThreeSweepsS, .speed_mps = kAheadMps},
                      [this](const RoutePlanner::Seen& seen) { look(seen); })) {
    for (const double width_m : member_widths_m) {
      agent::WorldMapper::Config config;
      config.map.criterion.member_width_m = width_m;
      mappers_.emplace_back(*scenario_.fleet.front().vehicle.lidar, config);
      reaches_.push_back({.member_width_m = width_m});
    }
  }

  std::vector<Reach> fly() {
    while (hovering_s_ < kThreeSweepsS + kSettledS + kAheadS) {
      explorer_.step();
      if (!explorer_.alive()) throw std::runtime_error("the explorer did not survive empty space");
    }
    for (std::size_t i = 0; i < reaches_.size(); ++i) {
      reaches_[i].ahead_m = median(ahead_m_[i]);
      reaches_[i].ahead_least_m = std::ranges::min(ahead_m_[i]);
    }
    return reaches_;
  }

 private:
  void look(const RoutePlanner::Seen& seen) {
    if (!seen.hovering_s) return;  // no beams of the climb: it differs from flight to flight
    for (agent::WorldMapper& mapper : mappers_) {
      for (const agent::BeamScan& scan : seen.beam_scans) mapper.insert(scan);
    }
    const auto comes = [&](double time_s) { return hovering_s_ < time_s && *seen.hovering_s >= time_s; };
    for (std::size_t i = 0; i < mappers_.size(); ++i) {
      Reach& reach = reaches_[i];
      if (comes(kOneSweepS)) all_round(mappers_[i].map(), seen.state, reach.one_sweep_m, reach.one_sweep_least_m);
      if (comes(kThreeSweepsS)) {
        all_round(mappers_[i].map(), seen.state, reach.three_sweeps_m, reach.three_sweeps_least_m);
      }
    }
    hovering_s_ = *seen.hovering_s;
    if (hovering_s_ < kThreeSweepsS + kSettledS || seen.tick % ticks(kAskEachS) != 0) return;
    for (std::size_t i = 0; i < mappers_.size(); ++i) {
      ahead_m_[i].push_back(free_way_m(mappers_[i].map(), seen.state.p_WB, Vector3d::UnitX(), tube_m_));
    }
  }

  void all_round(const agent::WorldMap& map, const RigidBodyState& state, double& middle_m, double& least_m) const {
    std::vector<double> ways_m;
    for (int i = 0; i < kDirections; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kDirections;
      ways_m.push_back(free_way_m(map, state.p_WB, {std::cos(angle), std::sin(angle), 0.0}, tube_m_));
    }
    middle_m = median(ways_m);
    least_m = std::ranges::min(ways_m);
  }

  const Scenario scenario_;
  const double tube_m_;
  std::deque<agent::WorldMapper> mappers_;
  std::vector<Reach> reaches_;
  std::vector<std::vector<double>> ahead_m_;
  double hovering_s_ = 0.0;
  Explorer explorer_;
};

/// Flies back and forth, each time a little faster, and stops in between.
class StopPlanner final : public agent::Planner {
 public:
  StopPlanner(double most_mps, std::vector<Stop>& stops) : most_mps_(most_mps), stops_(stops) {}

  bool over() const { return over_; }

  agent::PlannerOutput plan(const agent::PlannerInput& input) override {
    const Vector3d& p_WB = input.state.p_WB;
    if (phase_ == Phase::ground) {
      phase_ = Phase::rest;
      return {.motion = agent::Path{{{p_WB + 20.0 * Vector3d::UnitZ(), 3.0}}}};
    }
    const double speed = input.state.v_WB.norm();
    if (phase_ == Phase::rest && input.tracking.done && speed < kRestMps) return go(input);
    if (phase_ == Phase::go && speed < kReachedShare * speed_mps_) steady_since_ = input.tick;
    if (phase_ == Phase::go && input.tick - steady_since_ >= kTicksPerSecond) {
      phase_ = Phase::stop;
      stop_W_ = p_WB;
      stops_.push_back({speed_mps_, 0.0});
      return {.motion = agent::Hold{}};
    }
    if (phase_ == Phase::stop) {
      stops_.back().way_m = std::max(stops_.back().way_m, (p_WB - stop_W_).norm());
      if (speed < kRestMps && input.tracking.done) phase_ = Phase::rest;
    }
    return {};
  }

 private:
  enum class Phase { ground, rest, go, stop };
  static constexpr double kStepMps = 0.5, kRestMps = 0.03, kReachedShare = 0.97, kFarM = 300.0;

  agent::PlannerOutput go(const agent::PlannerInput& input) {
    over_ = speed_mps_ + kStepMps > most_mps_ + 1e-9;
    if (over_) return {};
    phase_ = Phase::go;
    speed_mps_ += kStepMps;
    along_ = -along_;
    steady_since_ = input.tick;
    const Vector3d to_W = input.tracking.setpoint.p_WB + along_ * kFarM * Vector3d::UnitX();
    return {.motion = agent::Path{{{to_W, speed_mps_}}}};
  }

  const double most_mps_;
  std::vector<Stop>& stops_;
  Phase phase_ = Phase::ground;
  double speed_mps_ = 0.0, along_ = -1.0;
  Tick steady_since_ = 0;
  Vector3d stop_W_ = Vector3d::Zero();
  bool over_ = false;
};

}  // namespace

std::vector<Reach> reaches(const std::vector<double>& member_widths_m, std::uint64_t seed) {
  return ReachFlight(member_widths_m, seed).fly();
}

std::vector<Stop> stops(std::uint64_t seed) {
  const Scenario scenario = lone_explorer(Vector2d::Zero());
  std::vector<Stop> stops;
  auto planner = std::make_unique<StopPlanner>(scenario.fleet.front().vehicle.max_speed_mps, stops);
  const StopPlanner& watched = *planner;
  Explorer explorer(scenario, Scene{}, seed, std::move(planner));
  while (!watched.over()) {
    explorer.step();
    if (!explorer.alive()) throw std::runtime_error("the explorer did not survive its stops");
  }
  return stops;
}

double speed_within(std::span<const Stop> stops, double way_m) {
  Stop below;
  for (const Stop& stop : stops) {
    if (stop.way_m > way_m) {
      const double share = (way_m - below.way_m) / (stop.way_m - below.way_m);
      return below.speed_mps + share * (stop.speed_mps - below.speed_mps);
    }
    below = stop;
  }
  return below.speed_mps;
}

}  // namespace skein::bench
