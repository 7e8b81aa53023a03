#include "uav_agent/flight_core/homing.hpp"

#include <algorithm>

#include "uav_agent/flight/delivery_places.hpp"
#include "uav_agent/flight/delivery_rule.hpp"
#include "uav_agent/flight/site.hpp"

namespace skein::agent {
namespace {

/// Factor on the time to a link, which a UAV that never had one has yet to find. Chosen.
constexpr double kNeverLinked = 1.7;
constexpr double kAboveAllM = 6.0;      ///< height of the last place, above all boxes; chosen
constexpr double kLowestM = 6.0;        ///< least height of a delivery place; chosen
constexpr std::size_t kMostPlaces = 8;  ///< places tried before the last one; chosen

}  // namespace

double Homing::way_home_s(const PlannerInput& in) const {
  const double way_s = time_home_s(in.state.p_WB, agent_.station_position, config_.approach_mps);
  if (!link_.linked_at_W()) return kNeverLinked * way_s;
  return std::min(way_s, time_home_s(in.state.p_WB, *link_.linked_at_W(), config_.approach_mps));
}

bool Homing::due(const PlannerInput& in) const {
  if (!in.mission_remaining_s || !link_.begun()) return false;
  if (*in.mission_remaining_s < way_home_s(in) + config_.return_margin_s && !link_.delivers_here(in)) return true;
  if (given_up_ && seconds(in.tick - *given_up_) < config_.deliver_every_s) return false;
  return pays(in);
}

/// Whether it is worth to interrupt the work for a delivery.
bool Homing::pays(const PlannerInput& in) const {
  const double waited_s = link_.waited_s(in);
  if (!stake_) return waited_s > config_.deliver_every_s;
  if (link_.delivers_here(in)) return false;
  const Vector3d& here_W = in.state.p_WB;
  double way_s = way_home_s(in);
  if (const auto linked_W = link_.linked_near_W(here_W)) {
    way_s = std::min(way_s, time_home_s(here_W, *linked_W, config_.approach_mps));
  }
  return delivery_pays(*stake_, config_.hazard_per_h, std::min(waited_s, left_s(in)), 2.0 * way_s);
}

bool Homing::done(const PlannerInput& in) const {
  const bool last_time =
      in.mission_remaining_s && *in.mission_remaining_s < 2.0 * (way_home_s(in) + config_.return_margin_s);
  return in.station_linked && in.undelivered_captures == 0 && !last_time;
}

std::vector<Vector3d> Homing::places(const PlannerInput& in, const FreeSpace& space) const {
  std::vector<Vector3d> places;
  const bool by_value = stake_ && in.mission_remaining_s && left_s(in) > 0.0;
  const auto linked_W = by_value ? link_.linked_near_W(in.state.p_WB) : link_.linked_at_W();
  if (linked_W) places.push_back(*linked_W);
  for (const Vector3d& p_W : delivery_places(agent_, space, kLowestM)) {
    if (places.size() < kMostPlaces) places.push_back(p_W);
  }
  const double above_m = top_of(in.boxes) + kAboveAllM + delivery_layer_m(agent_);
  places.emplace_back(agent_.station_position.x(), agent_.station_position.y(), above_m);
  return places;
}

}  // namespace skein::agent
