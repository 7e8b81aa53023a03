// The keys of a scenario's section `conditions`, each listed once. A section starts with the values of its preset; each
// further key in the section replaces one of these values. For scenario_reader.cpp and conditions.cpp.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "core/config/config_reader.hpp"
#include "core/scenario/conditions.hpp"
#include "core/text/suggestion.hpp"

namespace skein {

/// Calls `visit` with the name of each section and the member of ConditionsConfig that holds it.
void for_each_section(const auto& visit) {
  visit("wind", &ConditionsConfig::wind);
  visit("odometry", &ConditionsConfig::odometry);
  visit("battery", &ConditionsConfig::battery);
  visit("lidar", &ConditionsConfig::lidar);
  visit("camera", &ConditionsConfig::camera);
  visit("radio", &ConditionsConfig::radio);
}

inline const std::vector<std::string>& known_presets() {
  static const std::vector<std::string> known(kConditionPresets.begin(), kConditionPresets.end());
  return known;
}

/// Describes the key `preset`. @param apply  called after a preset is read: sets the section to the preset's values.
template <class R, class Apply>
void describe_preset(R& r, std::string& preset, const Apply& apply) {
  r.field("preset", preset);
  if constexpr (R::kReads) {
    const bool known = std::ranges::find(known_presets(), preset) != known_presets().end();
    r.check(known, "preset", "must be one of " + joined(known_presets()) + ", not '" + preset + "'");
    if (known && r.has("preset")) apply();
  }
}

void describe(auto& r, WindConditions& wind) {
  describe_preset(r, wind.preset, [&] { wind = conditions_preset(wind.preset).wind; });
  r.field("mean_mps", wind.mean_mps, within(0.0, 25.0));
  r.field("from_deg", wind.from_deg, within(-360.0, 360.0));
  r.field("roughness_length_m", wind.roughness_length_m, within(1e-4, 2.0));
  r.field("turbulence", wind.turbulence, within(0.0, 4.0));
  r.field("body_drag_area_m2", wind.body_drag_area_m2, within(0.0, 1.0));
  r.field("estimate_sigma_mps", wind.estimate_sigma_mps, within(0.0, 10.0));
  r.field("estimate_time_constant_s", wind.estimate_time_constant_s, within(0.05, 60.0));
}

void describe(auto& r, OdometryConditions& odometry) {
  describe_preset(r, odometry.preset, [&] { odometry = conditions_preset(odometry.preset).odometry; });
  r.field("horizontal_sigma_m", odometry.horizontal_sigma_m, within(0.0, 20.0));
  r.field("vertical_sigma_m", odometry.vertical_sigma_m, within(0.0, 20.0));
  r.field("time_constant_s", odometry.time_constant_s, within(0.1, 36000.0));
  r.field("yaw_sigma_deg", odometry.yaw_sigma_deg, within(0.0, 30.0));
  r.field("yaw_time_constant_s", odometry.yaw_time_constant_s, within(0.1, 36000.0));
  r.field("bias_sigma_m", odometry.bias_sigma_m, within(0.0, 20.0));
  r.field("noise_sigma_m", odometry.noise_sigma_m, within(0.0, 5.0));
  r.field("velocity_sigma_mps", odometry.velocity_sigma_mps, within(0.0, 5.0));
  r.field("latency_s", odometry.latency_s, within(0.0, 1.0));
  r.field("mean_fix_s", odometry.mean_fix_s, within(1.0, 36000.0));
  r.field("mean_lost_s", odometry.mean_lost_s, within(0.1, 3600.0));
  r.field("walk_m_per_sqrt_s", odometry.walk_m_per_sqrt_s, within(0.0, 5.0));
  r.field("known_start", odometry.known_start);
}

void describe(auto& r, BatteryConditions& battery) {
  describe_preset(r, battery.preset, [&] { battery = conditions_preset(battery.preset).battery; });
  r.field("endurance_missions", battery.endurance_missions, within(0.01, 100.0));
  r.field("reserve", battery.reserve, within(0.0, 0.9));
  r.field("efficiency", battery.efficiency, within(0.05, 1.0));
  r.field("avionics_w", battery.avionics_w, within(0.0, 1000.0));
  r.field("sag", battery.sag, within(0.0, 0.2));
  r.field("cells", battery.cells, within(1, 24));
  r.field("swap_s", battery.swap_s, within(1.0, 3600.0));
  r.field("swap_within_m", battery.swap_within_m, within(1.0, 10'000.0));
}

void describe(auto& r, LidarConditions& lidar) {
  describe_preset(r, lidar.preset, [&] { lidar = conditions_preset(lidar.preset).lidar; });
  r.field("sigma_per_m", lidar.sigma_per_m, within(0.0, 0.1));
  r.field("divergence_mrad", lidar.divergence_mrad, within(0.0, 20.0));
  r.field("reflectivity", lidar.reflectivity, within(0.001, 1.0));
  r.field("full_range_m", lidar.full_range_m, within(1.0, 1000.0));
  r.field("clutter_p", lidar.clutter_p, within(0.0, 0.1));
  r.field("clutter_mean_m", lidar.clutter_mean_m, within(0.1, 50.0));
}

void describe(auto& r, CameraConditions& camera) {
  describe_preset(r, camera.preset, [&] { camera = conditions_preset(camera.preset).camera; });
  r.field("exposure_factor", camera.exposure_factor, within(0.1, 100.0));
  r.field("vibration_deg_s", camera.vibration_deg_s, within(0.0, 100.0));
  r.field("shutter_delay_s", camera.shutter_delay_s, within(0.0, 1.0));
}

void describe(auto& r, RadioConditions& radio) {
  describe_preset(r, radio.preset, [&] { radio = conditions_preset(radio.preset).radio; });
  r.field("exponent", radio.exponent, within(1.0, 6.0));
  r.field("power_dbm", radio.power_dbm, within(-30.0, 50.0));
  r.field("loss_at_1m_db", radio.loss_at_1m_db, within(0.0, 100.0));
  r.field("shadowing_sigma_db", radio.shadowing_sigma_db, within(0.0, 20.0));
  r.field("decorrelation_m", radio.decorrelation_m, within(0.5, 1000.0));
  r.field("rate_share", radio.rate_share, Bounds{0.0, 1.0, true});
}

void describe(auto& r, ConditionsConfig& conditions) {
  describe_preset(r, conditions.preset, [&] { conditions = conditions_preset(conditions.preset); });
  for_each_section([&](const char* name, auto member) { r.field(name, conditions.*member); });
}

}  // namespace skein
