#include "uav_agent/flight/link_watch.hpp"

namespace skein::agent {
namespace {

constexpr double kLinkAgeS = 1.0;  ///< time between two noted places of a link; shorter links are not noted; chosen
constexpr double kStuckS = 5.0;    ///< without an arrival for this long, captures are not delivered from here; chosen

}  // namespace

void LinkWatch::update(const PlannerInput& in) {
  if (!delivered_at_ || in.undelivered_captures == 0) delivered_at_ = in.tick;
  const bool arrived = in.undelivered_captures == 0 || in.undelivered_captures < undelivered_;
  if (!arrived_at_ || arrived) arrived_at_ = in.tick;
  undelivered_ = in.undelivered_captures;
  if (in.station_linked) linked_at_ = in.tick;
  note_link(in);
}

/// Keeps the place where the UAV was at least kLinkAgeS before a link ended, and not the last place of the link: there,
/// the link broke.
void LinkWatch::note_link(const PlannerInput& in) {
  if (!in.station_linked) {
    sighting_.reset();
  } else if (!sighting_ || seconds(in.tick - sighting_->tick) >= kLinkAgeS) {
    if (sighting_) linked_at_W_ = sighting_->p_WB;
    sighting_ = {in.tick, in.tracking.setpoint.p_WB};
  }
}

bool LinkWatch::delivers_here(const PlannerInput& in) const {
  if (in.station_linked) return arrived_at_ && seconds(in.tick - *arrived_at_) < kStuckS;
  return in.undelivered_captures == 0 && linked_at_ && seconds(in.tick - *linked_at_) < kLinkAgeS;
}

bool LinkWatch::waits_for_longer_than(double time_s, const PlannerInput& in) const {
  return in.undelivered_captures > 0 && seconds(in.tick - *delivered_at_) > time_s;
}

}  // namespace skein::agent
