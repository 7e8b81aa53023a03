#include "core/conditions.hpp"

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "core/conditions_keys.hpp"
#include "core/config_writer.hpp"
#include "core/suggestion.hpp"
#include "core/types.hpp"

namespace skein {
namespace {

void name_all(ConditionsConfig& conditions, const std::string& preset) {
  conditions.preset = conditions.wind.preset = conditions.odometry.preset = conditions.battery.preset = preset;
  conditions.lidar.preset = conditions.camera.preset = conditions.radio.preset = preset;
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
  conditions.battery.endurance_missions = 1.5;
  conditions.lidar.sigma_per_m = 0.001;
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

std::vector<std::string> split_at(const std::string& text, const std::string& separators) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (separators.find(c) != std::string::npos) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

void check_preset(const std::string& preset) {
  const std::vector<std::string> known(kConditionPresets.begin(), kConditionPresets.end());
  if (std::ranges::find(known, preset) == known.end()) {
    throw InputError("there is no preset '" + preset + "' of conditions; " + suggestion(preset, known));
  }
}

/// The parts that may be chosen by themselves.
using Choose = std::function<void(ConditionsConfig&, const ConditionsConfig&)>;
const std::vector<std::pair<std::string, Choose>>& sections() {
  static const std::vector<std::pair<std::string, Choose>> all = {
      {"wind", [](ConditionsConfig& to, const ConditionsConfig& from) { to.wind = from.wind; }},
      {"odometry", [](ConditionsConfig& to, const ConditionsConfig& from) { to.odometry = from.odometry; }},
      {"battery", [](ConditionsConfig& to, const ConditionsConfig& from) { to.battery = from.battery; }},
      {"lidar", [](ConditionsConfig& to, const ConditionsConfig& from) { to.lidar = from.lidar; }},
      {"camera", [](ConditionsConfig& to, const ConditionsConfig& from) { to.camera = from.camera; }},
      {"radio", [](ConditionsConfig& to, const ConditionsConfig& from) { to.radio = from.radio; }}};
  return all;
}

template <class T>
bool same(const T& a, const T& b) {
  return config_to_yaml(a) == config_to_yaml(b);
}

/// The preset that a section is, or "own".
template <class T>
std::string section_text(const T& section, T ConditionsConfig::*member) {
  return same(section, conditions_preset(section.preset).*member) ? section.preset : "own";
}

}  // namespace

ConditionsConfig conditions_preset(const std::string& preset) {
  if (preset == "breezy") return breezy();
  if (preset == "harsh") return harsh();
  return {};
}

ConditionsConfig chosen_conditions(const std::string& text, const ConditionsConfig& base) {
  ConditionsConfig chosen = base;
  for (const std::string& part : split_at(text, ",+")) {
    const std::size_t equals = part.find('=');
    const std::string preset = equals == std::string::npos ? part : part.substr(equals + 1);
    check_preset(preset);
    if (equals == std::string::npos) {
      chosen = conditions_preset(preset);
      continue;
    }
    const std::string section = part.substr(0, equals);
    std::vector<std::string> names;
    bool found = false;
    for (const auto& [name, choose] : sections()) {
      names.push_back(name);
      if (name != section) continue;
      choose(chosen, conditions_preset(preset));
      found = true;
    }
    if (!found) throw InputError("there is no section '" + section + "' of conditions; " + suggestion(section, names));
  }
  return chosen;
}

std::string conditions_text(const ConditionsConfig& conditions) {
  const std::vector<std::pair<std::string, std::string>> parts = {
      {"wind", section_text(conditions.wind, &ConditionsConfig::wind)},
      {"odometry", section_text(conditions.odometry, &ConditionsConfig::odometry)},
      {"battery", section_text(conditions.battery, &ConditionsConfig::battery)},
      {"lidar", section_text(conditions.lidar, &ConditionsConfig::lidar)},
      {"camera", section_text(conditions.camera, &ConditionsConfig::camera)},
      {"radio", section_text(conditions.radio, &ConditionsConfig::radio)}};
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
