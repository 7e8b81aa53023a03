#include "core/scenario/conditions.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "core/config/config_writer.hpp"
#include "core/scenario/conditions_keys.hpp"
#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "core/types.hpp"

namespace skein {
namespace {

void name_all(ConditionsConfig& conditions, const std::string& preset) {
  conditions.preset = preset;
  for_each_section([&](const char*, auto member) { (conditions.*member).preset = preset; });
}

ConditionsConfig breezy() {
  ConditionsConfig conditions;
  name_all(conditions, "breezy");
  WindConditions& wind = conditions.wind;
  wind.mean_mps = 5.0;
  wind.turbulence = 1.0;
  OdometryConditions& odometry = conditions.odometry;
  odometry.horizontal_sigma_m = 0.10;
  odometry.vertical_sigma_m = 0.15;
  odometry.time_constant_s = 60.0;
  odometry.yaw_sigma_deg = 0.5;
  odometry.bias_sigma_m = 0.05;
  odometry.noise_sigma_m = 0.01;
  odometry.velocity_sigma_mps = 0.03;
  odometry.known_start = true;
  conditions.battery.endurance_missions = 1.5;
  conditions.lidar.sigma_per_m = 0.001;
  conditions.lidar.divergence_mrad = 3.0;
  conditions.lidar.reflectivity = 0.5;
  conditions.camera.exposure_factor = 1.5;
  conditions.camera.vibration_deg_s = 1.0;
  conditions.camera.shutter_delay_s = 0.02;
  conditions.radio.exponent = 2.2;
  return conditions;
}

ConditionsConfig harsh() {
  ConditionsConfig conditions = breezy();
  name_all(conditions, "harsh");
  WindConditions& wind = conditions.wind;
  wind.mean_mps = 10.0;
  wind.turbulence = 1.5;
  OdometryConditions& odometry = conditions.odometry;
  odometry.horizontal_sigma_m = 0.30;
  odometry.vertical_sigma_m = 0.45;
  odometry.yaw_sigma_deg = 1.5;
  odometry.bias_sigma_m = 0.10;
  odometry.noise_sigma_m = 0.02;
  odometry.velocity_sigma_mps = 0.05;
  odometry.latency_s = 0.05;
  odometry.mean_fix_s = 120.0;
  odometry.mean_lost_s = 8.0;
  odometry.walk_m_per_sqrt_s = 0.15;
  conditions.battery.endurance_missions = 0.8;
  conditions.lidar.sigma_per_m = 0.002;
  conditions.lidar.reflectivity = 0.2;
  conditions.lidar.clutter_p = 0.0002;
  conditions.camera.exposure_factor = 3.0;
  conditions.camera.vibration_deg_s = 3.0;
  conditions.camera.shutter_delay_s = 0.05;
  conditions.radio.exponent = 2.7;
  conditions.radio.shadowing_sigma_db = 5.3;
  return conditions;
}

void check_preset(const std::string& preset) {
  if (std::ranges::find(known_presets(), preset) == known_presets().end()) {
    throw InputError("there is no preset '" + preset + "' of conditions; " + suggestion(preset, known_presets()));
  }
}

/// The preset whose values a section has, or "own".
template <class T>
std::string section_text(const T& section, T ConditionsConfig::*member) {
  const ConditionsConfig preset = conditions_preset(section.preset);
  return config_to_yaml(section) == config_to_yaml(preset.*member) ? section.preset : "own";
}

}  // namespace

ConditionsConfig conditions_preset(const std::string& preset) {
  if (preset == "breezy") return breezy();
  if (preset == "harsh") return harsh();
  return {};
}

double lidar_sigma_m(const LidarConditions& lidar, double range_m, double tan_incidence) {
  return range_m *
         std::hypot(lidar.sigma_per_m, lidar_sigma_across(lidar) * std::min(tan_incidence, kMostTanIncidence));
}

std::vector<std::string> condition_sections() {
  std::vector<std::string> names;
  for_each_section([&](const char* name, auto) { names.emplace_back(name); });
  return names;
}

ConditionsConfig chosen_conditions(const std::string& text, const ConditionsConfig& base) {
  ConditionsConfig chosen = base;
  std::string parts = text;
  std::ranges::replace(parts, '+', ',');  // a list of presets needs '+', because its commas separate the presets
  std::set<std::string> named;
  for (const std::string& part : split(parts)) {
    const std::size_t equals = part.find('=');
    const std::string preset = equals == std::string::npos ? part : part.substr(equals + 1);
    check_preset(preset);
    if (equals == std::string::npos) {
      if (!named.empty()) {
        throw InputError("'" + part + "' is for all sections, so it stands once, and before single ones, such as '" +
                         preset + ",wind=none'");
      }
      named.insert("");
      chosen = conditions_preset(preset);
      continue;
    }
    const std::string section = part.substr(0, equals);
    for_each_section([&](const char* name, auto member) {
      if (section == name) chosen.*member = conditions_preset(preset).*member;
    });
    const std::vector<std::string> names = condition_sections();
    if (std::ranges::find(names, section) == names.end()) {
      throw InputError("there is no section '" + section + "' of conditions; " + suggestion(section, names));
    }
    if (!named.insert(section).second) throw InputError("the section '" + section + "' is named twice; name it once");
  }
  return chosen;
}

std::string conditions_text(const ConditionsConfig& conditions) {
  std::vector<std::pair<std::string, std::string>> parts;
  for_each_section(
      [&](const char* name, auto member) { parts.emplace_back(name, section_text(conditions.*member, member)); });
  const std::string& first = parts.front().second;
  const bool alike = std::ranges::all_of(parts, [&](const auto& part) { return part.second == first; });
  if (alike && first != "own") return first;
  std::string text = "none";
  for (const auto& [name, preset] : parts) {
    if (preset != "none") text += "," + name + "=" + preset;
  }
  return text;
}

}  // namespace skein
