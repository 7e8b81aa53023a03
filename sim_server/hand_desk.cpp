#include "sim_server/hand_desk.hpp"

#include <algorithm>
#include <utility>

namespace skein::sim {

HandDesk::HandDesk(const Scenario& scenario, const std::vector<UavIndex>& uavs) {
  for (const UavIndex uav : uavs) places_.push_back({uav, scenario.fleet.at(uav).name, {}, {}});
}

void HandDesk::take(const view::FlyOrder& order, Clock::time_point now) {
  const auto place = std::ranges::find(places_, order.uav, &Place::name);
  if (place == places_.end()) return;
  place->wanted = order.command;
  place->until = now + kHolds;
}

std::optional<HandCommand> HandDesk::news(UavIndex uav, Clock::time_point now) {
  const auto place = std::ranges::find(places_, uav, &Place::uav);
  if (place == places_.end()) return std::nullopt;
  if (now >= place->until) place->wanted = {};
  if (place->wanted == place->told) return std::nullopt;
  place->told = place->wanted;
  return place->told;
}

}  // namespace skein::sim
