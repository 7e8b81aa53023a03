#include "core/faults/conditions_change.hpp"

#include <array>
#include <utility>

#include "core/config/config_writer.hpp"
#include "core/scenario/conditions_check.hpp"
#include "core/scenario/conditions_keys.hpp"

namespace skein {
namespace {

/// Keys that a fault cannot change, because they are used only when a run begins: for random draws, to choose sizes, or
/// in the messages that tell programs the conditions.
constexpr std::array kFixedKeys = {std::pair("wind", "from_deg"),         std::pair("odometry", "bias_sigma_m"),
                                   std::pair("odometry", "latency_s"),    std::pair("odometry", "mean_fix_s"),
                                   std::pair("odometry", "known_start"),  std::pair("battery", "endurance_missions"),
                                   std::pair("battery", "reserve"),       std::pair("battery", "sag"),
                                   std::pair("battery", "cells"),         std::pair("battery", "swap_s"),
                                   std::pair("battery", "swap_within_m"), std::pair("radio", "decorrelation_m"),
                                   std::pair("radio", "rate_share")};

/// Overwrites conditions with values; an absent key keeps its value.
void read_onto(ConditionsConfig& conditions, const ConfigNode& values, const std::string& path, ConfigErrors& errors) {
  config_detail::read_value(config_detail::Place{values, path, errors}, conditions, Bounds{});
}

/// The scenario's values of kFixedKeys, as a section `conditions`.
ConfigNode fixed_values(const ConditionsConfig& conditions) {
  const ConfigNode all = ConfigWriter::node_of(conditions).value_or(ConfigNode::make_map());
  ConfigNode fixed = ConfigNode::make_map();
  for_each_section([&](const char* section, auto) {
    ConfigNode keys = ConfigNode::make_map();
    for (const auto& [of, key] : kFixedKeys) {
      if (std::string(of) != section) continue;
      const ConfigNode* value = all.find(section)->find(key);
      keys.add(key, value ? *value : ConfigNode{});
    }
    fixed.add(section, std::move(keys));
  });
  return fixed;
}

/// A preset in `values` sets every key. So the scenario's values of kFixedKeys are restored afterwards.
ConditionsConfig with_change(const ConditionsConfig& before, const ConfigNode& values, const ConfigNode& fixed) {
  ConditionsConfig after = before;
  const ConfigDocument document{"conditions", values};
  ConfigErrors errors(document);
  read_onto(after, values, "", errors);
  read_onto(after, fixed, "", errors);
  errors.throw_if_any();
  return after;
}

}  // namespace

std::vector<std::size_t> active_changes(const FaultPlan& plan, Tick tick) {
  std::vector<std::size_t> faults;
  for (std::size_t i = 0; i < plan.faults.size(); ++i) {
    const Fault& fault = plan.faults[i];
    if (std::holds_alternative<ConditionsChange>(fault.action) && fault.active(tick)) faults.push_back(i);
  }
  return faults;
}

ConditionsConfig changed_conditions(const FaultPlan& plan, const Scenario& scenario,
                                    const std::vector<std::size_t>& faults) {
  ConditionsConfig now = scenario.conditions;
  const ConfigNode fixed = fixed_values(scenario.conditions);
  for (const std::size_t i : faults)
    now = with_change(now, std::get<ConditionsChange>(plan.faults[i].action).values, fixed);
  return now;
}

void check_conditions_change(const ConfigNode& values, const Scenario& scenario, const std::string& path,
                             ConfigErrors& errors) {
  errors.check(!values.keys.empty(), path, "must have values of conditions, as {wind: {mean_mps: 12}}");
  for (std::size_t i = 0; i < values.items.size(); ++i) {
    const bool empty = values.items[i].kind == ConfigNode::Kind::map && values.items[i].keys.empty();
    errors.check(!empty, path + "." + values.keys[i], "changes nothing: give at least one value, or leave it out");
  }
  for (const auto& [section, key] : kFixedKeys) {
    const ConfigNode* part = values.find(section);
    errors.check(part == nullptr || part->find(key) == nullptr, path + "." + section + "." + key,
                 "cannot change in a run");
  }
  ConditionsConfig after = scenario.conditions;
  const std::size_t errors_before = errors.count();
  read_onto(after, values, path, errors);
  if (errors.count() > errors_before) return;
  read_onto(after, fixed_values(scenario.conditions), path, errors);
  // These parts have a state that is created when the run begins, so a fault cannot switch them on.
  const auto check_part = [&](const char* section, auto member) {
    const ConfigNode* part = values.find(section);
    const bool off = !(after.*member).on() && (part == nullptr || !sets_condition(*part));
    errors.check((scenario.conditions.*member).on() || off, path + "." + section,
                 "is off in the scenario, and a fault cannot switch it on: fly with --conditions " +
                     std::string(section) + "=breezy, say");
  };
  check_part("wind", &ConditionsConfig::wind);
  check_part("odometry", &ConditionsConfig::odometry);
  check_part("battery", &ConditionsConfig::battery);
  check_part("radio", &ConditionsConfig::radio);
  errors.check(!scenario.conditions.radio.on() || after.radio.on(), path + ".radio", "cannot switch the path loss off");
}

}  // namespace skein
