#include "signals/live_signals.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace skein::signals {

LiveSignals::LiveSignals(const Scenario& scenario, const LiveWorld& world)
    : scenario_(scenario), world_(world), captures_(scenario.fleet.size()) {
  for (const std::string& name : SignalNames(scenario).programs) members_.emplace(name, Member());
}

void LiveSignals::end_step(const std::function<bool(const std::string&)>& is_member) {
  for (auto& [name, member] : members_) {
    const bool present = is_member(name);
    member.restarts += present && !member.present && member.was_present;
    member.leaves += !present && member.present;
    member.present = present;
    member.was_present = member.was_present || present;
  }
  for (const UavIndex uav : world_.captures()) ++captures_[uav].taken;
}

double LiveSignals::value(const SignalUse& signal) const {
  if (signal.is("time")) return seconds(world_.tick());
  if (signal.is("separation")) return separation(signal);
  if (signal.is("clearance")) return clearance(signal);
  if (signal.is("member")) return members_.at(signal.argument(0)).present ? 1.0 : 0.0;
  if (signal.is("restarts")) return changes(signal.argument(0), &Member::restarts);
  if (signal.is("leaves")) return changes(signal.argument(0), &Member::leaves);
  if (signal.is("link")) return linked(signal) ? 1.0 : 0.0;
  if (signal.is("faults")) {
    return static_cast<double>(
        std::ranges::count_if(world_.faults(), [&](const Fault& fault) { return fault.active(world_.tick()); }));
  }
  if (signal.is("captures")) return sum(signal, [](const Captures& one) { return one.taken; });
  if (signal.is("acknowledged")) return sum(signal, [](const Captures& one) { return one.released; });
  if (signal.is("held")) return sum(signal, [](const Captures& one) { return one.taken - one.released; });
  if (signal.is("debug")) {
    const auto found = debug_.find({uav_of(signal), signal.argument(1)});
    return found == debug_.end() ? 0.0 : found->second;
  }
  return of_uav(signal);
}

double LiveSignals::of_uav(const SignalUse& signal) const {
  const LiveWorld::Uav uav = world_.uav(uav_of(signal));
  if (signal.is("x")) return uav.state.p_WB.x();
  if (signal.is("y")) return uav.state.p_WB.y();
  if (signal.is("z")) return uav.state.p_WB.z();
  if (signal.is("speed")) return uav.state.v_WB.norm();
  if (signal.is("charge")) return uav.charge;
  if (signal.is("alive")) return uav.alive ? 1.0 : 0.0;
  throw std::logic_error("no live signal: " + signal.text());
}

UavIndex LiveSignals::uav_of(const SignalUse& signal, std::size_t place) const {
  return scenario_.uav_index(signal.argument(place));
}

double LiveSignals::separation(const SignalUse& signal) const {
  const std::string one = signal.argument(0), other = signal.argument(1);
  double least_m = std::numeric_limits<double>::infinity();
  for (const UavIndex a : scenario_.uavs()) {
    for (const UavIndex b : FirstUavs(a)) {
      const std::string &name_a = scenario_.fleet[a].name, &name_b = scenario_.fleet[b].name;
      const auto concerns = [&](const std::string& name) { return name.empty() || name == name_a || name == name_b; };
      const LiveWorld::Uav uav_a = world_.uav(a), uav_b = world_.uav(b);
      if (!concerns(one) || !concerns(other) || !uav_a.alive || !uav_b.alive) continue;
      least_m = std::min(least_m, (uav_a.state.p_WB - uav_b.state.p_WB).norm());
    }
  }
  return least_m;
}

double LiveSignals::clearance(const SignalUse& signal) const {
  if (!signal.argument(0).empty()) return world_.clearance(uav_of(signal));
  double least_m = kFarClearance_m;
  for (const UavIndex i : scenario_.uavs()) {
    if (world_.uav(i).alive) least_m = std::min(least_m, world_.clearance(i));
  }
  return least_m;
}

double LiveSignals::changes(const std::string& member, int Member::*kind) const {
  double sum = 0.0;
  for (const auto& [name, one] : members_) sum += member.empty() || name == member ? one.*kind : 0;
  return sum;
}

bool LiveSignals::linked(const SignalUse& signal) const {
  const auto node = [&](const std::string& name) {
    return name == scenario_.node_name(kStationNode) ? kStationNode : node_of_uav(scenario_.uav_index(name));
  };
  return world_.is_open(node(signal.argument(0)), node(signal.argument(1)));
}

double LiveSignals::sum(const SignalUse& signal, const std::function<double(const Captures&)>& of) const {
  if (!signal.argument(0).empty()) return of(captures_[uav_of(signal)]);
  double total = 0.0;
  for (const Captures& one : captures_) total += of(one);
  return total;
}

}  // namespace skein::signals
