#include "uav_agent/flight/delivery.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "uav_agent/flight/proof.hpp"

namespace skein::agent {
namespace {

constexpr double kDetour = 1.5;
constexpr double kNeverLinked = 1.7;    ///< times as long: it has yet to find from where the station is seen
constexpr double kFixedS = 6.0;         ///< to stop, turn and speed up
constexpr double kLayerM = 3.0;         ///< between the heights of two UAVs
constexpr double kSightRadiusM = 0.8;   ///< of the tube that must be clear of mapped cells
constexpr double kStationM = 3.0;       ///< the station's own surroundings are mapped: they do not count
constexpr double kAboveStationM = 3.0;  ///< what it stands on, a roof perhaps, hides it from below
constexpr int kDirections = 12;
constexpr double kAboveAllM = 6.0;      ///< where no place is known
constexpr double kRetryS = 1.0;         ///< after no way was found
constexpr double kLinkPatienceS = 4.0;  ///< at a place without a link
constexpr int kFailuresToRetreat = 3;
constexpr double kNearerM = 3.0;       ///< nearer to a place that cannot be reached
constexpr int kFailuresToAskLess = 4;  ///< proof of free space: what is not delivered is worth nothing
constexpr double kOutwards[] = {4.0, 8.0, 14.0, 22.0, 32.0};

}  // namespace

std::vector<Vector3d> delivery_places(const AgentConfig& agent, const FreeSpace& space, double lowest_m) {
  struct Candidate {
    double cost;
    Vector3d p_W;
  };
  std::vector<Candidate> candidates;
  const double lowest_in_sight_m = std::max(lowest_m, agent.station_position.z() + kAboveStationM);
  const double height = lowest_in_sight_m + kLayerM * static_cast<double>(agent.self);
  const double own_direction =
      2.0 * std::numbers::pi * static_cast<double>(agent.self) / static_cast<double>(agent.fleet.size());
  for (const double outwards : kOutwards) {
    for (int i = 0; i < kDirections; ++i) {
      const double turn = 2.0 * std::numbers::pi * i / kDirections;
      const Vector3d p(agent.station_position.x() + outwards * std::cos(own_direction + turn),
                       agent.station_position.y() + outwards * std::sin(own_direction + turn), height);
      const Vector3d above_station = agent.station_position + (p - agent.station_position).normalized() * kStationM;
      if (!space.free(p) || !space.sees(p, above_station, kSightRadiusM)) continue;
      candidates.push_back({outwards * (1.0 + std::min(i, kDirections - i)), p});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
  std::vector<Vector3d> places;
  for (const Candidate& candidate : candidates) places.push_back(candidate.p_W);
  return places;
}

double time_home_s(const Vector3d& from_W, const Vector3d& place_W, double speed_mps) {
  return kDetour * (place_W - from_W).norm() / speed_mps + kFixedS;
}

Vector3d Delivery::home() const {
  if (place_ < places_.size()) return places_[place_];
  const double height = top_m_ + kAboveAllM + kLayerM * static_cast<double>(agent_.self);
  return {agent_.station_position.x(), agent_.station_position.y(), height};
}

void Delivery::update(const PlannerInput& in, double top_m) {
  top_m_ = top_m;
  link_.update(in);
}

double Delivery::way_home_s(const PlannerInput& in) const {
  const double way_s = time_home_s(in.state.p_WB, home(), config_.speed_mps);
  if (!link_.linked_at_W()) return kNeverLinked * way_s;
  return std::min(way_s, time_home_s(in.state.p_WB, *link_.linked_at_W(), config_.speed_mps));
}

bool Delivery::due(const PlannerInput& in) const {
  if (!in.mission_remaining_s || !link_.begun()) return false;
  if (*in.mission_remaining_s < way_home_s(in) + config_.margin_s && !link_.delivers_here(in)) return true;
  return link_.waits_for_longer_than(config_.every_s, in);
}

void Delivery::begin(const PlannerInput& in, const FreeSpace::Config& space, double lowest_m, PlannerOutput& out) {
  places_ = delivery_places(agent_, FreeSpace(space, in.boxes, in.map), lowest_m);
  place_ = 0;
  if (link_.linked_at_W()) {
    const double way_s = time_home_s(in.state.p_WB, home(), config_.speed_mps);
    if (way_home_s(in) < way_s) places_.insert(places_.begin(), *link_.linked_at_W());
  }
  failures_ = 0;
  unlinked_since_.reset();
  next_try_ = in.tick;
  pilot_.stop(out);
  step(in, space, out);
}

bool Delivery::step(const PlannerInput& in, const FreeSpace::Config& space, PlannerOutput& out) {
  const bool all_delivered = in.station_linked && in.undelivered_captures == 0;
  const bool last_time = in.mission_remaining_s && *in.mission_remaining_s < 2.0 * (way_home_s(in) + config_.margin_s);
  if (all_delivered && !last_time) return true;
  if (all_delivered || (in.station_linked && in.tracking.done)) {
    unlinked_since_.reset();
    return false;
  }
  if (pilot_.arrived(in) && !heading_home_) pilot_.stop(out);  // after a retreat
  if (pilot_.arrived(in)) {
    if (!unlinked_since_) unlinked_since_ = in.tick;
    if (seconds(in.tick - *unlinked_since_) < kLinkPatienceS) return false;
    unlinked_since_.reset();
    next_place();
    pilot_.stop(out);
  }
  if (pilot_.has_path() || in.tick < next_try_) return false;
  next_try_ = in.tick + ticks(kRetryS);
  FreeSpace::Config way = space;
  way.rays = Proof::of(space.rays, static_cast<std::size_t>(failures_ / kFailuresToAskLess), agent_.me().role);
  heading_home_ = pilot_.fly_to(home(), in, way, out).found;
  if (heading_home_) return false;
  if (++failures_ % kFailuresToRetreat == 0 && !approach(home(), in, way, out)) pilot_.retreat(in, out, false);
  next_place();
  return false;
}

/// As near as it gets: there it may see the station, or how to go on. @returns whether it sets out.
bool Delivery::approach(const Vector3d& p_W, const PlannerInput& in, const FreeSpace::Config& space,
                        PlannerOutput& out) {
  const Vector3d here = in.tracking.setpoint.p_WB;
  FreeSpace::Config way = space;
  way.floor_m = std::min(way.floor_m, here.z());
  return pilot_.fly_nearer(p_W, kNearerM, in, way, out);
}

void Delivery::try_again(const PlannerInput& in) { next_try_ = in.tick + ticks(kRetryS); }

void Delivery::try_elsewhere(const PlannerInput& in) {
  next_place();
  try_again(in);
}

}  // namespace skein::agent
