#include "uav_agent/flight/link_watch.hpp"

#include <algorithm>
#include <cmath>

namespace skein::agent {
namespace {

constexpr double kLinkAgeS = 1.0;  ///< time between two noted places of a link; shorter links are not noted; chosen
constexpr double kStuckS = 5.0;    ///< without an arrival for this long, captures are not delivered from here; chosen
constexpr double kCubeM = 8.0;     ///< edge of the cubes in which linked places are kept; chosen

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
    if (sighting_) {
      linked_at_W_ = sighting_->p_WB;
      const Eigen::Vector3i cube = (*linked_at_W_ / kCubeM).array().floor().cast<int>();
      linked_W_[{cube.x(), cube.y(), cube.z()}] = *linked_at_W_;
    }
    sighting_ = {in.tick, in.tracking.setpoint.p_WB};
  }
}

bool LinkWatch::delivers_here(const PlannerInput& in) const {
  if (in.station_linked) return arrived_at_ && seconds(in.tick - *arrived_at_) < kStuckS;
  return in.undelivered_captures == 0 && linked_at_ && seconds(in.tick - *linked_at_) < kLinkAgeS;
}

double LinkWatch::waited_s(const PlannerInput& in) const {
  return in.undelivered_captures > 0 ? seconds(in.tick - *delivered_at_) : 0.0;
}

std::optional<Vector3d> LinkWatch::linked_near_W(const Vector3d& p_W) const {
  const auto off_m = [&](const auto& linked) { return (linked.second - p_W).norm(); };
  const auto nearest = std::ranges::min_element(linked_W_, {}, off_m);
  return nearest == linked_W_.end() ? std::nullopt : std::optional(nearest->second);
}

}  // namespace skein::agent
