// A scenario: all settings of a run that are fixed before it starts. Plain structs with their defaults;
// core/scenario/scenario_reader.hpp fills them from YAML and rejects invalid values.
// Units: SI and radians unless the name says otherwise. Angles in files are in degrees, as CARIC has them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/radio/link_effect.hpp"
#include "core/scenario/conditions.hpp"
#include "core/types.hpp"

namespace skein {

struct CameraConfig {
  double hfov_deg = 80.0, vfov_deg = 60.0;
  double exposure_s = 0.001;
  double trigger_interval_s = 0.1;  ///< the next exposure is possible when strictly more than this has elapsed
  double focal_length_m = 0.016;
  double pixel_size_m = 4.35e-6;
  Vector3d p_BC = {0.2, 0.0, -0.3};  ///< camera's position in B [m]; so it moves when the body rolls or pitches
};

struct GimbalConfig {
  double pitch_limit_deg = 80.0, yaw_limit_deg = 90.0;
  double rate_limit_deg_s = 60.0;
};

/// Sectors of LiDAR columns whose beams return nothing for a while, as with low sun, or dark or oblique surfaces.
struct DroppedSectors {
  double share = 0.0;      ///< share of the columns that is dropped, on average over time
  double width_deg = 0.0;  ///< width of a sector; two sectors may be adjacent
  double hold_s = 0.0;     ///< time after which new sectors are drawn
};

struct LidarConfig {
  int rings = 16, columns = 440;
  double vertical_fov_deg = 30.0;  ///< symmetric about the scan plane
  double rate_hz = 10.0;
  double range_min_m = 0.9, range_max_m = 50.0;
  double sigma_m = 0.01;           ///< range noise; drawn only with a seed other than 0
  double servo_rate_deg_s = 45.0;  ///< about the x axis of B; the sign changes every half period
  double servo_period_s = 8.0;
  double servo_limit_deg = 90.0;
  bool motion_distortion = false;  ///< beams are fired one after the other, while body and servo move
  double no_return_p = 0.0;        ///< probability that a beam's return is lost; drawn only with a seed other than 0
  std::optional<DroppedSectors> dropped_sectors;  ///< drawn only with a seed other than 0
};

/// Gains of CARIC's position controller (docs/rules.md, golden position_control).
struct PositionControlConfig {
  double omega_xy = 2.0, omega_z = 4.0;
  double zeta_xy = 1.0, zeta_z = 1.1;
  double ki_xy = 0.03, ki_z = 0.07;
  double thrust_scale = 159.0;
  double max_tilt_deg = 45.0;
};

/// The attitude controller's gains, and the inertia that it assumes (golden attitude_control).
struct AttitudeControlConfig {
  std::optional<Vector3d> inertia;  ///< diagonal [kg m^2]; nullopt: VehicleConfig::inertia
  double p_gain = 40.0, q_gain = 25.0, r_gain = 20.0;
};

/// A part that is fixed to the body: it adds to mass and inertia, and collides if it has a box.
struct VehicleLink {
  std::string name;
  double mass_kg = 0.0;
  Vector3d inertia = Vector3d::Zero();  ///< about its centre of mass, diagonal in the axes of B [kg m^2]
  Vector3d p_BL = Vector3d::Zero();     ///< its centre of mass, also the centre of its box [m]
  std::optional<Vector3d> box_m;        ///< full edge lengths
};

/// One vehicle type; files in config/vehicles/. core/vehicle/airframe.hpp computes the total mass.
struct VehicleConfig {
  std::string name;
  Role role = Role::explorer;
  double mass_kg = 3.385;                                            ///< of the body alone, without rotors and links
  Vector3d inertia = {0.07648816666, 0.07648816666, 0.16283333333};  ///< of the body about Bo, diagonal [kg m^2]
  double rotor_mass_kg = 0.0;                                        ///< of each rotor
  std::vector<VehicleLink> links;
  double arm_m = 0.43, rotor_radius_m = 0.2, rotor_height_m = 0.074;
  double rotor_force_constant = 2.564574e-5;  ///< thrust = constant * speed^2 [N s^2]
  double rotor_moment_constant = 0.032;       ///< torque = constant * thrust [m]
  double rotor_max_speed = 900.0;             ///< [rad/s]
  double motor_time_constant_up_s = 0.0125, motor_time_constant_down_s = 0.025;
  double rotor_drag = 8.06428e-5, rolling_moment = 1e-6;
  Vector3d collision_box_m = {0.2, 0.2, 0.32};  ///< full edge lengths
  double antenna_offset_m = 0.2;
  double max_speed_mps = 6.0, max_acceleration_mps2 = 4.0, max_yaw_rate_deg_s = 90.0;  ///< limits of a command
  PositionControlConfig position_control;
  AttitudeControlConfig attitude_control;
  CameraConfig camera;
  GimbalConfig gimbal;
  std::optional<LidarConfig> lidar;
};

struct UavConfig {
  std::string name;
  VehicleConfig vehicle;
  Vector2d start = Vector2d::Zero();  ///< x, y on the ground [m]
  double start_yaw = 0.0;
};

struct RadioTopicConfig {
  std::string name;                  ///< ROS name, "/broadcast"
  std::string type;                  ///< ROS type, "std_msgs/msg/String"
  std::vector<std::string> sources;  ///< node names, or {"all"}
  std::vector<std::string> targets;  ///< node names, or {"all"}
};

/// Source of the structure: files in CARIC's layout, or a procedural family.
struct SceneConfig {
  std::string family;  ///< procedural: "towers"; empty: files
  std::uint64_t scene_seed = 0;
  std::vector<std::filesystem::path> meshes;  ///< STL, OBJ, PLY, COLLADA or glTF; resolved path
  std::filesystem::path points;               ///< PCD; resolved path
  std::filesystem::path boxes;                ///< box_description.yaml; resolved path
};

/// Named switches; presets `contest`, `paper` and `reference`. docs/rules.md explains each.
struct RulesConfig {
  std::string preset = "contest";
  bool reject_commands_beyond_limits = true;  ///< a velocity, acceleration or yaw rate beyond the vehicle's is ignored
  bool guard_position_commands = true;        ///< a UAV approaches a commanded position and yaw within its limits
  bool limit_search_radius = true;            ///< S1: the camera looks no farther than the search radius
  bool unnormalised_displacement = true;      ///< S4 of the reference's resolution formula
  bool ray_ends_at_point = false;             ///< S10: the visibility ray ends at the point, in single precision
  bool own_body_hides = true;                 ///< S11: parts of the own UAV in the view hide what is behind them
  bool camera_blind_in_structure = true;  ///< no picture while structure stands between the body's centre and camera
  bool phantom_gimbal_rate = false;       ///< G1-G3: the gimbal reports rates at which it does not move
  bool collision_kills_both = false;      ///< a UAV at rest that a flying UAV touches is out of the run, too
  bool collision_voids_score = true;      ///< a UAV that collides loses its points, retroactively
  double min_point_score = 0.2;           ///< a capture of a point below this does not count
  double takeoff_height_m = 0.1;          ///< an airborne UAV is this far above its rest_height() ...
  double takeoff_speed_mps = 0.1;         ///< ... and faster than this
};

struct Scenario {
  std::filesystem::path file;
  std::vector<std::filesystem::path> vehicle_files;  ///< files from which the fleet's vehicles were read
  std::string name;
  std::string description;
  double duration_s = 600.0;          ///< mission time, from the first takeoff
  double takeoff_timeout_s = 60.0;    ///< the run ends if no UAV has taken off by then
  double exchange_period_s = 0.05;    ///< duration of one lock-step exchange
  double desired_mm_per_pixel = 2.0;  ///< r_des in the paper
  Vector3d station_position = {-2.0, 8.0, 0.3};
  double station_antenna_offset_m = 0.1;
  SceneConfig scene;
  RulesConfig rules;
  ConditionsConfig conditions;          ///< wind, odometry errors, batteries, ...; none by default
  std::vector<UavConfig> fleet;         ///< its order determines node numbers, domains, and which UAV wins a tie
  std::vector<RadioTopicConfig> radio;  ///< radio topics in addition to those that Skein itself declares
  std::vector<LinkEffect> links;        ///< effects on radio links during the whole run

  FirstUavs uavs() const { return FirstUavs(fleet.size()); }
  FirstNodes nodes() const { return FirstNodes(fleet.size() + 1); }
  /// @throws InputError when no UAV has this name; the message lists the names.
  UavIndex uav_index(const std::string& uav_name) const;
  /// Names in fleet order.
  std::vector<std::string> uav_names() const;
  /// Name of a radio node: "gcs" or the UAV's.
  const std::string& node_name(Node node) const;
  /// Exchange period in physics ticks.
  Tick exchange_ticks() const { return ticks(exchange_period_s); }
};

}  // namespace skein
