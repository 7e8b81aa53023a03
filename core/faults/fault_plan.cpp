#include "core/faults/fault_plan.hpp"

#include <algorithm>
#include <cmath>

#include "core/overloaded.hpp"
#include "core/text/suggestion.hpp"

namespace skein {
namespace {

Tick tick_at_or_after(double time_s) { return static_cast<Tick>(std::ceil(time_s / kTickS - 1e-6)); }

const char* key_of(const FaultAction& action) {
  return std::visit(
      Overloaded{
          [](const LinkEffect&) { return "link"; }, [](const Partition&) { return "partition"; },
          [](const Blackout&) { return "blackout"; }, [](const StationOutage&) { return "station_outage"; },
          [](const Kill&) { return "kill"; }, [](const Pause&) { return "pause"; },
          [](const LidarFailure&) { return "lidar_failure"; }, [](const CameraFailure&) { return "camera_failure"; },
          [](const MotorFailure&) { return "motor_failure"; }, [](const CommandDelay&) { return "command_delay"; },
          [](const OdometryFreeze&) { return "odometry_freeze"; }, [](const OdometryJump&) { return "odometry_jump"; },
          [](const StuckGimbal&) { return "stuck_gimbal"; }, [](const Gust&) { return "gust"; },
          [](const FixLoss&) { return "fix_loss"; }, [](const BatteryLoss&) { return "battery_loss"; },
          [](const ConditionsChange&) { return "conditions"; }},
      action);
}

}  // namespace

Tick Fault::begin() const { return tick_at_or_after(at_s); }

std::optional<Tick> Fault::end() const { return until_s ? std::optional(tick_at_or_after(*until_s)) : std::nullopt; }

void Fault::set_off(Tick tick) {
  waits = false;
  at_s = seconds(tick);
  if (for_s) until_s = std::min(until_s.value_or(at_s + *for_s), at_s + *for_s);
}

bool Fault::may_begin(Tick tick) const { return waits && tick >= begin() && (!end() || tick < *end()); }

std::string fault_path(std::size_t index) { return "faults[" + std::to_string(index) + "]"; }

std::string fault_kind(const Fault& fault) { return key_of(fault.action); }

std::string fault_target(const Fault& fault) {
  const auto groups = [](const Partition& partition) {
    std::vector<std::string> texts;
    for (const auto& group : partition.groups) texts.push_back(joined(group, " "));
    return joined(texts, " | ");
  };
  return std::visit(Overloaded{[](const LinkEffect& f) { return joined(f.from, " ") + " > " + joined(f.to, " "); },
                               groups, [](const StationOutage&) { return std::string("gcs"); },
                               [](const Kill& f) { return f.member; }, [](const Pause& f) { return f.member; },
                               [](const ConditionsChange& f) { return joined(f.values.keys, " "); },
                               [](const auto& f) { return f.uav; }},
                    fault.action);
}

std::optional<LinkMatrix<std::uint8_t>> cut_links(const FaultPlan& plan, const Scenario& scenario, Tick tick) {
  std::optional<LinkMatrix<std::uint8_t>> cut;
  const auto cut_where = [&](const auto& is_cut) {
    if (!cut) cut.emplace(scenario.fleet.size() + 1);
    for (const Node from : scenario.nodes()) {
      for (const Node to : scenario.nodes()) {
        if (from != to && is_cut(from, to)) cut->at(from, to) = 1;
      }
    }
  };
  const auto silence = [&](Node silent) { cut_where([&](Node a, Node b) { return a == silent || b == silent; }); };
  for (const Fault& fault : plan.faults) {
    if (!fault.active(tick)) continue;
    if (std::holds_alternative<StationOutage>(fault.action)) silence(kStationNode);
    if (const auto* blackout = std::get_if<Blackout>(&fault.action)) {
      silence(node_of_uav(scenario.uav_index(blackout->uav)));
    }
    if (const auto* partition = std::get_if<Partition>(&fault.action)) {
      const auto group = [&](Node node) {
        for (std::size_t i = 0; i < partition->groups.size(); ++i) {
          if (names_node(partition->groups[i], scenario.node_name(node))) return i;
        }
        return partition->groups.size() + node;
      };
      cut_where([&](Node a, Node b) { return group(a) != group(b); });
    }
  }
  return cut;
}

}  // namespace skein
