#include "uav_agent/flight_core/homing.hpp"

#include <algorithm>

#include "uav_agent/flight/delivery.hpp"
#include "uav_agent/flight/site.hpp"

namespace skein::agent {
namespace {

constexpr double kNeverLinked = 1.7;  ///< times as long: it has yet to find from where the station is seen
constexpr double kPlaceLayerM = 3.0;  ///< between the heights of two UAVs
constexpr double kAboveAllM = 6.0;
constexpr double kLowestM = 6.0;   ///< of a place
constexpr double kLinkAgeS = 1.0;  ///< between two sightings: a link that lasts
constexpr double kStuckS = 5.0;    ///< with a link, and nothing arrives: not from here
constexpr std::size_t kMostPlaces = 8;

}  // namespace

void Homing::update(const PlannerInput& in) {
  if (!delivered_at_ || in.undelivered_captures == 0) delivered_at_ = in.tick;
  const bool arrived = in.undelivered_captures == 0 || in.undelivered_captures < undelivered_;
  if (!arrived_at_ || arrived) arrived_at_ = in.tick;
  undelivered_ = in.undelivered_captures;
  if (in.station_linked) linked_at_ = in.tick;
  note_link(in);
}

/// The place that is kept lies at least kLinkAgeS before the end of the link: not where it just broke.
void Homing::note_link(const PlannerInput& in) {
  if (!in.station_linked) {
    sighting_.reset();
  } else if (!sighting_ || seconds(in.tick - sighting_->tick) >= kLinkAgeS) {
    if (sighting_) linked_at_W_ = sighting_->p_WB;
    sighting_ = {in.tick, in.tracking.setpoint.p_WB};
  }
}

double Homing::way_home_s(const PlannerInput& in) const {
  const double way_s = time_home_s(in.state.p_WB, agent_.station_position, config_.approach_mps);
  if (!linked_at_W_) return kNeverLinked * way_s;
  return std::min(way_s, time_home_s(in.state.p_WB, *linked_at_W_, config_.approach_mps));
}

/// What is taken here arrives, one by one on a poor link. A link that has just gone may be back, where nothing waits
/// for it.
bool Homing::delivers_here(const PlannerInput& in) const {
  if (in.station_linked) return arrived_at_ && seconds(in.tick - *arrived_at_) < kStuckS;
  return in.undelivered_captures == 0 && linked_at_ && seconds(in.tick - *linked_at_) < kLinkAgeS;
}

bool Homing::due(const PlannerInput& in) const {
  if (!in.mission_remaining_s || !delivered_at_) return false;
  if (*in.mission_remaining_s < way_home_s(in) + config_.return_margin_s && !delivers_here(in)) return true;
  return in.undelivered_captures > 0 && seconds(in.tick - *delivered_at_) > config_.deliver_every_s;
}

bool Homing::done(const PlannerInput& in) const {
  const bool last_time =
      in.mission_remaining_s && *in.mission_remaining_s < 2.0 * (way_home_s(in) + config_.return_margin_s);
  return in.station_linked && in.undelivered_captures == 0 && !last_time;
}

std::vector<Vector3d> Homing::places(const PlannerInput& in, const FreeSpace& space) const {
  std::vector<Vector3d> places;
  if (linked_at_W_) places.push_back(*linked_at_W_);
  for (const Vector3d& p_W : delivery_places(agent_, space, kLowestM)) {
    if (places.size() < kMostPlaces) places.push_back(p_W);
  }
  const double above_m = top_of(in.boxes) + kAboveAllM + kPlaceLayerM * static_cast<double>(agent_.self);
  places.emplace_back(agent_.station_position.x(), agent_.station_position.y(), above_m);
  return places;
}

}  // namespace skein::agent
