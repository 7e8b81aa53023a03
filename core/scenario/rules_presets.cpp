// Presets of rules, and the switches in which rules differ from their preset.
#include <array>

#include "core/scenario/scenario_keys.hpp"
#include "core/text/suggestion.hpp"

namespace skein {
namespace {

/// Collects the switches that describe() lists.
struct SwitchList {
  static constexpr bool kReads = false;
  void field(const std::string&, const std::string&) {}  // the preset's name
  void field(const std::string& key, bool value) { all.emplace_back(key, value); }
  void field(const std::string& key, double value, const Bounds& = {}) { all.emplace_back(key, value); }

  std::vector<RuleSwitch> all;
};

}  // namespace

std::span<const RulesConfig> rules_presets() {
  static const auto presets = [] {
    const RulesConfig contest;
    RulesConfig paper;
    paper.preset = "paper";
    paper.limit_search_radius = false;
    paper.unnormalised_displacement = false;
    paper.min_point_score = 0.0;
    RulesConfig reference;
    reference.preset = "reference";
    reference.ray_ends_at_point = true;
    reference.camera_blind_in_structure = false;
    reference.phantom_gimbal_rate = true;
    reference.reject_commands_beyond_limits = false;
    reference.guard_position_commands = false;
    reference.collision_voids_score = false;
    return std::array{contest, paper, reference};
  }();
  return presets;
}

RulesConfig rules_preset(const std::string& preset) {
  std::vector<std::string> names;
  for (const RulesConfig& rules : rules_presets()) {
    if (rules.preset == preset) return rules;
    names.push_back(rules.preset);
  }
  throw InputError("there is no rules preset '" + preset + "'; " + suggestion(preset, names));
}

std::vector<RuleSwitch> own_switches(const RulesConfig& rules) {
  RulesConfig own = rules, preset = rules_preset(rules.preset);
  SwitchList switches, usual;
  describe(switches, own);
  describe(usual, preset);
  std::vector<RuleSwitch> differing;
  for (std::size_t i = 0; i < switches.all.size(); ++i) {
    if (switches.all[i] != usual.all[i]) differing.push_back(switches.all[i]);
  }
  return differing;
}

}  // namespace skein
