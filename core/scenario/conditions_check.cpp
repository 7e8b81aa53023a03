#include "core/scenario/conditions_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/config/config_writer.hpp"
#include "core/scenario/conditions_keys.hpp"
#include "core/text/text.hpp"

namespace skein {
namespace {

/// A section whose keys have no effect unless one of `switches` is set. Those of LiDAR and camera are not here: a fault
/// can switch them on.
struct SwitchedSection {
  const char* name;
  std::vector<std::string> switches;
  const char* advice;
};

const std::array<SwitchedSection, 4>& switched_sections() {
  static const std::array<SwitchedSection, 4> sections = {
      {{"wind", {"mean_mps"}, "needs mean_mps, or a preset that has it (breezy, harsh): otherwise there is no wind"},
       {"odometry",
        {"horizontal_sigma_m", "vertical_sigma_m", "yaw_sigma_deg", "bias_sigma_m", "noise_sigma_m",
         "velocity_sigma_mps", "latency_s", "mean_fix_s"},
        "needs an error, such as horizontal_sigma_m, or a preset that has one (breezy, harsh): otherwise odometry is "
        "exact"},
       {"battery",
        {"endurance_missions"},
        "needs endurance_missions, or a preset that has it (breezy, harsh): otherwise there are no batteries"},
       {"radio",
        {"exponent"},
        "needs exponent, or a preset that has it (breezy, harsh): otherwise links have no path loss"}}};
  return sections;
}

bool acts_alone(const std::string& key) { return key == "preset" || key == "body_drag_area_m2"; }

std::string text_of(const ConfigNode* node) { return node == nullptr ? std::string() : to_yaml(*node); }

void check_section(const SwitchedSection& section, const ConfigNode& given, const ConfigNode& now,
                   const ConfigNode& off, ConfigErrors& errors) {
  const auto is_given = [&](const std::string& key) { return given.find(key) != nullptr; };
  if (std::ranges::any_of(section.switches, is_given)) return;
  for (const std::string& key : given.keys) {
    // Exported scenarios have all keys, also those of sections that are off, with their default values.
    if (acts_alone(key) || text_of(now.find(key)) == text_of(off.find(key))) continue;
    errors.check(false, std::string("conditions.") + section.name + "." + key, section.advice);
  }
}

}  // namespace

bool sets_condition(const ConfigNode& section) { return !std::ranges::all_of(section.keys, acts_alone); }

void check_conditions(const ConfigDocument& document, const ConditionsConfig& conditions, double exchange_period_s,
                      ConfigErrors& errors) {
  const ConfigNode* given = document.root.find("conditions");
  if (given == nullptr) return;
  // If exchanges are long, the latency of a preset may be rounded to 0 exchanges.
  const double latency_s = conditions.odometry.latency_s;
  const bool is_preset = latency_s == conditions_preset(conditions.odometry.preset).odometry.latency_s;
  errors.check(latency_s == 0.0 || is_preset || std::lround(latency_s / exchange_period_s) > 0,
               "conditions.odometry.latency_s",
               "must be 0, or at least half of exchange_period_s, " + number_text(exchange_period_s) +
                   ": it is rounded to whole exchanges");
  for_each_section([&](const char* name, auto member) {
    const auto section = std::ranges::find(switched_sections(), std::string(name), &SwitchedSection::name);
    const ConfigNode* keys = given->find(name);
    if (section == switched_sections().end() || keys == nullptr || (conditions.*member).on()) return;
    check_section(*section, *keys, ConfigWriter::node_of(conditions.*member).value_or(ConfigNode{}),
                  ConfigWriter::node_of(conditions_preset("none").*member).value_or(ConfigNode{}), errors);
  });
}

}  // namespace skein
