// The keys of scenario and vehicle files, each listed once: reading, range checks and printing follow these lists.
// For scenario_reader.cpp, rules_presets.cpp and their tests only. The structs and their defaults are in scenario.hpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/config/config_reader.hpp"
#include "core/math/euler.hpp"
#include "core/scenario/conditions_keys.hpp"
#include "core/scenario/drawn_worlds.hpp"
#include "core/scenario/scenario.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "core/text/suggestion.hpp"
#include "core/vehicle/airframe.hpp"

namespace skein {

void describe(auto& r, CameraConfig& camera) {
  r.field("hfov_deg", camera.hfov_deg, within(1.0, 170.0));
  r.field("vfov_deg", camera.vfov_deg, within(1.0, 170.0));
  r.field("exposure_s", camera.exposure_s, within(0.0, 1.0));
  r.field("trigger_interval_s", camera.trigger_interval_s, within(kTickS, 60.0));
  r.field("focal_length_m", camera.focal_length_m, within(1e-4, 10.0));
  r.field("pixel_size_m", camera.pixel_size_m, within(1e-8, 1e-3));
  r.field("p_BC", camera.p_BC, within(-10.0, 10.0));
}

void describe(auto& r, GimbalConfig& gimbal) {
  r.field("pitch_limit_deg", gimbal.pitch_limit_deg, within(0.0, 180.0));
  r.field("yaw_limit_deg", gimbal.yaw_limit_deg, within(0.0, 180.0));
  r.field("rate_limit_deg_s", gimbal.rate_limit_deg_s, within(0.0, 3600.0));
}

void describe(auto& r, DroppedSectors& sectors) {
  r.required("share", sectors.share, within(0.0, 0.5));
  r.required("width_deg", sectors.width_deg, Bounds{0.0, 360.0, true});
  r.required("hold_s", sectors.hold_s, within(kTickS, 36000.0));
}

void describe(auto& r, LidarConfig& lidar) {
  r.field("rings", lidar.rings, within(1, 128));
  r.field("columns", lidar.columns, within(1, 4096));
  r.field("vertical_fov_deg", lidar.vertical_fov_deg, within(0.0, 170.0));
  r.field("rate_hz", lidar.rate_hz, within(0.1, 20.0));
  r.field("range_min_m", lidar.range_min_m, within(0.0, 1000.0));
  r.field("range_max_m", lidar.range_max_m, within(0.1, 1000.0));
  r.field("sigma_m", lidar.sigma_m, within(0.0, 1.0));
  r.field("servo_rate_deg_s", lidar.servo_rate_deg_s, within(0.0, 720.0));
  r.field("servo_period_s", lidar.servo_period_s, within(0.1, 600.0));
  r.field("servo_limit_deg", lidar.servo_limit_deg, within(0.0, 180.0));
  r.field("motion_distortion", lidar.motion_distortion);
  r.field("no_return_p", lidar.no_return_p, within(0.0, 0.5));
  r.field("dropped_sectors", lidar.dropped_sectors);
  r.check(lidar.range_min_m < lidar.range_max_m, "range_min_m", "must be less than range_max_m");
}

void describe(auto& r, PositionControlConfig& control) {
  r.field("omega_xy", control.omega_xy, within(0.0, 100.0));
  r.field("omega_z", control.omega_z, within(0.0, 100.0));
  r.field("zeta_xy", control.zeta_xy, within(0.0, 100.0));
  r.field("zeta_z", control.zeta_z, within(0.0, 100.0));
  r.field("ki_xy", control.ki_xy, within(0.0, 100.0));
  r.field("ki_z", control.ki_z, within(0.0, 100.0));
  r.field("thrust_scale", control.thrust_scale, within(0.1, 1e5));
  r.field("max_tilt_deg", control.max_tilt_deg, within(1.0, 89.0));
}

void describe(auto& r, AttitudeControlConfig& control) {
  r.field("inertia_kg_m2", control.inertia, within(1e-6, 1e4));
  r.field("p_gain", control.p_gain, within(0.0, 1e4));
  r.field("q_gain", control.q_gain, within(0.0, 1e4));
  r.field("r_gain", control.r_gain, within(0.0, 1e4));
}

void describe(auto& r, VehicleLink& link) {
  r.required("name", link.name);
  r.required("mass_kg", link.mass_kg, within(0.0, 1000.0));
  r.field("inertia_kg_m2", link.inertia, within(0.0, 1e4));
  r.required("p_BL", link.p_BL, within(-10.0, 10.0));
  r.field("box_m", link.box_m, within(0.01, 10.0));
}

/// Adds an error for values that no real vehicle has, and with which the integration in steps of one tick is unstable.
void check_plausible(auto& r, const VehicleConfig& vehicle) {
  constexpr double kMostThrust = 50.0, kMostTurn = 5000.0, kMostLoss = 0.1;  // see the messages
  const MassProperties whole = mass_properties(vehicle);
  const double inertia = whole.I_BBcm_B.diagonal().minCoeff();
  const double speed = kRotors * vehicle.rotor_max_speed;  // of all rotors together
  const double thrust = speed * vehicle.rotor_force_constant * vehicle.rotor_max_speed;
  r.check(thrust <= kMostThrust * 9.8 * whole.mass_kg, "mass_kg",
          "its rotors would lift more than 50 times its weight: no vehicle is as light as that");
  r.check(vehicle.arm_m * thrust <= 3.0 * kMostTurn * inertia, "inertia_kg_m2",
          "its rotors would turn it at more than 5000 rad/s^2: no vehicle is as slight as that");
  const double reach2 = vehicle.arm_m * vehicle.arm_m + vehicle.rotor_height_m * vehicle.rotor_height_m;
  r.check(vehicle.rotor_drag * speed * kTickS <= kMostLoss * std::min(whole.mass_kg, inertia / reach2), "rotor_drag",
          "it would cost the vehicle more than a tenth of its speed or of its turn in a tick of 2.5 ms");
  r.check(vehicle.rolling_moment * speed * kTickS <= kMostLoss * inertia, "rolling_moment",
          "at 1 m/s it would turn the vehicle by more than 0.1 rad/s in a tick of 2.5 ms");
}

void describe(auto& r, VehicleConfig& vehicle) {
  r.required("name", vehicle.name);
  r.required("role", vehicle.role);
  r.field("mass_kg", vehicle.mass_kg, within(0.01, 1000.0));
  r.field("inertia_kg_m2", vehicle.inertia, within(1e-6, 1e4));
  r.field("rotor_mass_kg", vehicle.rotor_mass_kg, within(0.0, 100.0));
  r.field("links", vehicle.links);
  r.field("arm_m", vehicle.arm_m, within(0.01, 10.0));
  r.field("rotor_radius_m", vehicle.rotor_radius_m, within(0.0, 10.0));
  r.field("rotor_height_m", vehicle.rotor_height_m, within(-10.0, 10.0));
  r.field("rotor_force_constant", vehicle.rotor_force_constant, within(1e-9, 1.0));
  r.field("rotor_moment_constant", vehicle.rotor_moment_constant, within(1e-6, 10.0));
  r.field("rotor_max_speed_rad_s", vehicle.rotor_max_speed, within(1.0, 1e5));
  r.field("motor_time_constant_up_s", vehicle.motor_time_constant_up_s, within(kTickS, 10.0));
  r.field("motor_time_constant_down_s", vehicle.motor_time_constant_down_s, within(kTickS, 10.0));
  r.field("rotor_drag", vehicle.rotor_drag, within(0.0, 1.0));
  r.field("rolling_moment", vehicle.rolling_moment, within(0.0, 1.0));
  r.field("collision_box_m", vehicle.collision_box_m, within(0.01, 10.0));
  r.field("antenna_offset_m", vehicle.antenna_offset_m, within(0.0, 10.0));
  r.field("max_speed_mps", vehicle.max_speed_mps, within(0.1, 100.0));
  r.field("max_acceleration_mps2", vehicle.max_acceleration_mps2, within(0.1, 100.0));
  r.field("max_yaw_rate_deg_s", vehicle.max_yaw_rate_deg_s, within(1.0, 3600.0));
  r.field("position_control", vehicle.position_control);
  r.field("attitude_control", vehicle.attitude_control);
  r.field("camera", vehicle.camera);
  r.field("gimbal", vehicle.gimbal);
  r.field("lidar", vehicle.lidar);
  r.check(!vehicle.name.empty(), "name", "must not be empty");
  check_plausible(r, vehicle);
  r.check(vehicle.role != Role::explorer || vehicle.lidar.has_value(), "role",
          "an explorer needs a section 'lidar' ('lidar: {}' for the usual one)");
}

template <class R>
void describe(R& r, SceneConfig& scene) {
  if (R::kReads || !scene.family.empty()) {
    r.field("family", scene.family);
    r.field("scene_seed", scene.scene_seed);
  }
  if (R::kReads || from_files(scene)) {
    r.field("meshes", scene.meshes);
    r.field("points", scene.points);
    r.field("boxes", scene.boxes);
  }
}

template <class R>
void describe(R& r, RulesConfig& rules) {
  r.field("preset", rules.preset);
  if constexpr (R::kReads) {  // the preset first, then the switches that differ from it
    const auto presets = rules_presets();
    const auto preset = std::ranges::find(presets, rules.preset, &RulesConfig::preset);
    std::vector<std::string> names;
    for (const RulesConfig& known : presets) names.push_back(known.preset);
    r.check(preset != presets.end(), "preset", "must be one of " + joined(names) + ", not '" + rules.preset + "'");
    if (preset != presets.end()) rules = *preset;
  }
  r.field("reject_commands_beyond_limits", rules.reject_commands_beyond_limits);
  r.field("guard_position_commands", rules.guard_position_commands);
  r.field("limit_search_radius", rules.limit_search_radius);
  r.field("unnormalised_displacement", rules.unnormalised_displacement);
  r.field("ray_ends_at_point", rules.ray_ends_at_point);
  r.field("own_body_hides", rules.own_body_hides);
  r.field("camera_blind_in_structure", rules.camera_blind_in_structure);
  r.field("phantom_gimbal_rate", rules.phantom_gimbal_rate);
  r.field("collision_kills_both", rules.collision_kills_both);
  r.field("collision_voids_score", rules.collision_voids_score);
  r.field("min_point_score", rules.min_point_score, within(0.0, 1.0));
  r.field("takeoff_height_m", rules.takeoff_height_m, within(0.0, 100.0));
  r.field("takeoff_speed_mps", rules.takeoff_speed_mps, within(0.0, 100.0));
}

/// Nodes of a radio topic: a list of names, or the single word `all`.
using NodeNames = std::variant<std::string, std::vector<std::string>>;

void describe_nodes(auto& r, const std::string& key, std::vector<std::string>& nodes) {
  NodeNames names = nodes;
  if (nodes.size() == 1 && nodes[0] == "all") names = std::string("all");
  r.required(key, names);
  nodes = names.index() == 0 ? std::vector<std::string>{std::get<0>(names)} : std::get<1>(names);
}

void describe(auto& r, RadioTopicConfig& topic) {
  r.required("name", topic.name);
  r.required("type", topic.type);
  describe_nodes(r, "sources", topic.sources);
  describe_nodes(r, "targets", topic.targets);
}

/// An entry of `fleet`: its vehicle is a name, a path, or all of a vehicle file's keys in place.
struct FleetEntry {
  std::string name;
  std::variant<std::string, VehicleConfig> vehicle;
  std::optional<Vector2d> start;  ///< x, y in W [m]; none: the start that the procedural scene has for this UAV
  std::optional<double> start_yaw_deg;

  void describe(auto& r) {
    r.required("name", name);
    r.required("vehicle", vehicle);
    r.field("start", start, within(-1e4, 1e4));
    r.field("start_yaw_deg", start_yaw_deg, within(-360.0, 360.0));
  }
};

struct StationKeys {
  Scenario& scenario;

  void describe(auto& r) {
    r.field("position", scenario.station_position, within(-1e4, 1e4));
    r.field("antenna_offset_m", scenario.station_antenna_offset_m, within(0.0, 10.0));
  }
};

struct RadioKeys {
  Scenario& scenario;

  void describe(auto& r) {
    r.field("topics", scenario.radio);
    r.field("links", scenario.links);
  }
};

/// A scenario file. Its fleet is read separately, because the vehicles are looked up afterwards.
struct ScenarioFile {
  Scenario scenario;
  std::vector<FleetEntry> fleet;

  template <class R>
  void describe(R& r) {
    StationKeys station{scenario};
    RadioKeys radio{scenario};
    r.field("name", scenario.name);
    r.field("description", scenario.description);
    r.field("duration_s", scenario.duration_s, Bounds{0.0, 36000.0, true});
    r.field("takeoff_timeout_s", scenario.takeoff_timeout_s, Bounds{0.0, 36000.0, true});
    r.field("exchange_period_s", scenario.exchange_period_s, within(kTickS, 1.0));
    r.required("desired_mm_per_pixel", scenario.desired_mm_per_pixel, Bounds{0.0, 1000.0, true});
    r.field("station", station);
    r.required("scene", scenario.scene);
    r.field("rules", scenario.rules);
    if (R::kReads || conditions_text(scenario.conditions) != "none") r.field("conditions", scenario.conditions);
    r.required("fleet", fleet);
    r.field("radio", radio);
  }
};

}  // namespace skein
