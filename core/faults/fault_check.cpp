#include "core/faults/fault_check.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>
#include <set>

#include "core/faults/conditions_change.hpp"
#include "core/overloaded.hpp"
#include "core/radio/link_check.hpp"
#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"

namespace skein {

bool has_exchange(const Fault& fault, const Scenario& scenario) {
  const std::optional<Tick> end = fault.end();
  const Tick period = scenario.exchange_ticks();
  return !end || (fault.begin() + period - 1) / period * period < *end;
}

std::optional<std::string> held_by(const FaultAction& action) {
  using Text = std::optional<std::string>;
  return std::visit(
      Overloaded{[](const LinkEffect&) -> Text { return std::nullopt; },
                 [](const Partition&) -> Text { return "the partition"; },
                 [](const Blackout& f) -> Text { return "the radio of " + f.uav; },
                 [](const StationOutage&) -> Text { return "the radio of gcs"; },
                 [](const Kill& f) -> Text { return "the process of " + f.member; },
                 [](const Pause& f) -> Text { return "the process of " + f.member; },
                 [](const LidarFailure& f) -> Text { return "the LiDAR of " + f.uav; },
                 [](const CameraFailure& f) -> Text { return "the camera of " + f.uav; },
                 [](const MotorFailure& f) -> Text { return "rotor " + std::to_string(f.rotor) + " of " + f.uav; },
                 [](const CommandDelay& f) -> Text { return "the commands of " + f.uav; },
                 [](const OdometryFreeze& f) -> Text { return "the odometry of " + f.uav; },
                 [](const OdometryJump& f) -> Text { return "the odometry of " + f.uav; },
                 [](const StuckGimbal& f) -> Text { return "the gimbal of " + f.uav; },
                 [](const Gust& f) -> Text { return "the air about " + f.uav; },
                 [](const FixLoss& f) -> Text { return "the position fix of " + f.uav; },
                 [](const BatteryLoss& f) -> Text { return "the battery of " + f.uav; },
                 [](const ConditionsChange&) -> Text { return std::nullopt; }},
      action);
}

FaultChecker::FaultChecker(const Scenario& scenario, ConfigErrors& errors, double latest_s)
    : scenario_(scenario), errors_(errors), latest_s_(latest_s), uavs_(scenario.uav_names()) {
  nodes_ = uavs_;
  nodes_.insert(nodes_.begin(), scenario.node_name(kStationNode));
  members_ = nodes_;
  members_.insert(members_.end(), {"station", "comm_router"});
}

void FaultChecker::check(const Fault& longest, const Fault& shortest, const std::string& path) {
  check_times(longest, shortest, path);
  const std::string key = path + "." + fault_kind(longest);
  std::visit(
      Overloaded{
          [&](const LinkEffect& f) { check_link_effect(f, nodes_, key, errors_); },
          [&](const Partition& f) { check_partition(f, key); }, [&](const Blackout& f) { check_uav(f.uav, key); },
          [](const StationOutage&) {}, [&](const Kill& f) { check_name(f.member, members_, key, "program"); },
          [&](const Pause& f) { check_name(f.member, members_, key, "program"); },
          [&](const LidarFailure& f) { check_lidar(f, key); }, [&](const CameraFailure& f) { check_uav(f.uav, key); },
          [&](const MotorFailure& f) { check_uav(f.uav, key + ".uav"); },
          [&](const CommandDelay& f) { check_uav(f.uav, key + ".uav"); },
          [&](const OdometryFreeze& f) { check_uav(f.uav, key); },
          [&](const OdometryJump& f) { check_uav(f.uav, key + ".uav"); },
          [&](const StuckGimbal& f) { check_uav(f.uav, key); }, [&](const Gust& f) { check_uav(f.uav, key + ".uav"); },
          [&](const FixLoss& f) { check_fix(f, key); }, [&](const BatteryLoss& f) { check_battery(f, key); },
          [&](const ConditionsChange& f) { check_conditions_change(f.values, scenario_, key, errors_); }},
      longest.action);
  check_contradiction(longest, path);
}

void FaultChecker::check_times(const Fault& longest, const Fault& shortest, const std::string& path) {
  const std::string end = number_text(scenario_.duration_s);
  errors_.check(shortest.at_s < latest_s_, path + ".at_s",
                "is after the end: the mission of '" + scenario_.name + "' lasts " + end + " s");
  if (!longest.until_s) return;
  errors_.check(shortest.until_s > shortest.at_s, path + ".until_s",
                "must be later than at_s, " + number_text(shortest.at_s));
  if (*longest.until_s > longest.at_s && !has_exchange(longest, scenario_)) add_never_acts(longest, path);
  errors_.check(*longest.until_s <= latest_s_, path + ".until_s",
                "is after the end: the mission of '" + scenario_.name + "' lasts " + end +
                    " s; leave the key out for a fault that lasts to the end");
}

void FaultChecker::add_never_acts(const Fault& fault, const std::string& path) {
  const Tick period = scenario_.exchange_ticks(), since_exchange = fault.begin() % period;
  const std::string begin = number_text(fault.at_s);
  if (since_exchange == 0) {
    errors_.check(false, path + ".until_s",
                  "must be at least " + number_text(kTickS) + " s, one tick of simulated time, later than at_s, " +
                      begin + ": a shorter fault never acts");
    return;
  }
  errors_.check(false, path,
                "no exchange begins between " + begin + " s and " + number_text(*fault.until_s) +
                    " s, so the fault would never act: exchanges begin every " +
                    number_text(scenario_.exchange_period_s) + " s, the next one at " +
                    number_text(seconds(fault.begin() - since_exchange + period)) + " s; let it end later");
}

void FaultChecker::check_name(const std::string& name, const std::vector<std::string>& known, const std::string& key,
                              const std::string& what) {
  const bool found = std::find(known.begin(), known.end(), name) != known.end();
  errors_.check(found, key, "there is no " + what + " '" + name + "'; " + suggestion(name, known));
}

void FaultChecker::check_partition(const Partition& partition, const std::string& key) {
  errors_.check(!partition.groups.empty(), key, "must be a list of groups, each a list of nodes");
  std::set<std::string> seen;
  for (const auto& group : partition.groups) {
    errors_.check(!group.empty(), key, "must have no empty group: leave it out; a node in no group is cut off anyway");
    for (const std::string& name : group) {
      check_name(name, nodes_, key, "node");
      errors_.check(seen.insert(name).second, key, "'" + name + "' is in two groups");
    }
  }
  errors_.check(partition.groups.size() != 1 || seen.size() < nodes_.size(), key,
                "changes nothing: all nodes are in one group; leave out those that are to be cut off");
}

void FaultChecker::check_lidar(const LidarFailure& failure, const std::string& key) {
  check_name(failure.uav, uavs_, key, "UAV");
  const auto uav = std::find(uavs_.begin(), uavs_.end(), failure.uav);
  if (uav == uavs_.end()) return;
  const bool has_one = scenario_.fleet[static_cast<std::size_t>(uav - uavs_.begin())].vehicle.lidar.has_value();
  errors_.check(has_one, key, "'" + failure.uav + "' has no LiDAR");
}

void FaultChecker::check_fix(const FixLoss& loss, const std::string& key) {
  check_uav(loss.uav, key);
  errors_.check(scenario_.conditions.odometry.on(), key,
                "needs a scenario whose odometry has errors, as with --conditions odometry=breezy");
}

void FaultChecker::check_battery(const BatteryLoss& loss, const std::string& key) {
  check_uav(loss.uav, key + ".uav");
  errors_.check(scenario_.conditions.battery.on(), key,
                "needs a scenario with batteries, as with --conditions battery=breezy");
}

void FaultChecker::check_contradiction(const Fault& fault, const std::string& path) {
  const auto held = held_by(fault.action);
  if (!held) return;
  std::map<Tick, Holder>& holders = holders_[*held];
  const Tick end = fault.end().value_or(std::numeric_limits<Tick>::max());
  const auto next = holders.lower_bound(fault.begin());
  const Holder* other = next != holders.end() && next->first < end ? &next->second : nullptr;
  if (next != holders.begin() && std::prev(next)->second.end > fault.begin()) other = &std::prev(next)->second;
  if (other == nullptr) {
    holders.emplace(fault.begin(), Holder{end, path});
  } else {
    errors_.check(
        false, path,
        "contradicts " + other->path + ": both affect " + *held + " at the same time; change one of the times");
  }
}

}  // namespace skein
