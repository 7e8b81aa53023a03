// What a world does that an ideal one does not: wind, errors of odometry and LiDAR, blur, batteries that run empty,
// radio that fades. All of it is off by default, and then no bit of a run differs from one without this file.
// docs/conditions.md has the model of each part, its parameters with their sources, and the presets.
// Units: SI and radians unless the name says otherwise.  Pure; safe from any thread.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace skein {

/// Mean wind with a logarithmic height profile, and Dryden gusts about it.
struct WindConditions {
  std::string preset = "none";
  double mean_mps = 0.0;                  ///< at 10 m above the ground
  std::optional<double> from_deg = {};    ///< 0: from the east, 90: from the north; none: drawn by the seed
  double roughness_length_m = 0.03;       ///< of the ground, in the logarithmic law
  double turbulence = 0.0;                ///< times the intensities of MIL-F-8785C; 0: no gusts
  double body_drag_area_m2 = 0.03;        ///< drag coefficient times area, of the body without its rotors
  double estimate_sigma_mps = 0.5;        ///< of what a UAV is told of the wind, each component
  double estimate_time_constant_s = 2.0;  ///< by which that lags behind the wind

  bool on() const { return mean_mps > 0.0; }
};

/// How far a UAV's odometry is off: first-order Gauss-Markov processes, a constant, and white noise.
struct OdometryConditions {
  std::string preset = "none";
  double horizontal_sigma_m = 0.0, vertical_sigma_m = 0.0;  ///< stationary, of each axis
  double time_constant_s = 60.0;                            ///< of both
  double yaw_sigma_deg = 0.0;
  double yaw_time_constant_s = 60.0;
  double bias_sigma_m = 0.0;              ///< of a constant offset of each axis, drawn once
  double noise_sigma_m = 0.0;             ///< white, of each sample and axis; in the messages alone
  double velocity_sigma_mps = 0.0;        ///< white, of each sample and axis; in the messages alone
  double latency_s = 0.0;                 ///< of the messages, rounded to whole exchanges; their stamps say so
  std::optional<double> mean_fix_s = {};  ///< how long the fix lasts on average; none: for ever
  double mean_lost_s = 10.0;              ///< how long it is lost on average
  double walk_m_per_sqrt_s = 0.1;         ///< of the random walk of each axis while it is lost

  bool on() const {
    return horizontal_sigma_m > 0.0 || vertical_sigma_m > 0.0 || yaw_sigma_deg > 0.0 || bias_sigma_m > 0.0 ||
           noise_sigma_m > 0.0 || velocity_sigma_mps > 0.0 || latency_s > 0.0 || mean_fix_s.has_value();
  }
};

/// Energy by rotor power; the pack is sized by how long it lets the UAV hover.
struct BatteryConditions {
  std::string preset = "none";
  std::optional<double> endurance_missions =
      {};                    ///< hovering in still air, in durations of the mission; none: no battery
  double reserve = 0.2;      ///< share of the charge that a UAV is to land with
  double efficiency = 0.55;  ///< ideal power of the rotors to electric power
  double avionics_w = 15.0;  ///< computer, camera, LiDAR
  double sag = 0.05;         ///< share of its voltage that the pack loses while the UAV hovers
  int cells = 6;             ///< in series

  bool on() const { return endurance_missions.has_value(); }
};

/// What a LiDAR loses and adds.
struct LidarConditions {
  std::string preset = "none";
  double sigma_per_m = 0.0;                 ///< range noise that grows with the range, on top of the vehicle's sigma_m
  std::optional<double> reflectivity = {};  ///< of all surfaces, seen perpendicularly; none: every return arrives
  double full_range_m = 100.0;              ///< at which a perpendicular white surface is just seen
  double clutter_p = 0.0;                   ///< of a beam: to be returned by rain or dust
  double clutter_mean_m = 4.0;              ///< beyond the least range, exponential

  bool on() const { return sigma_per_m > 0.0 || reflectivity.has_value() || clutter_p > 0.0; }
};

/// What makes pictures worse than the vehicle's file says.
struct CameraConditions {
  std::string preset = "none";
  double exposure_factor = 1.0;  ///< times the vehicle's exposure time: less light
  double vibration_deg_s = 0.0;  ///< standard deviation of each component of the camera's turn, in each picture
  double shutter_delay_s = 0.0;  ///< from the trigger to the picture

  bool on() const { return exposure_factor != 1.0 || vibration_deg_s > 0.0 || shutter_delay_s > 0.0; }
};

/// A rate that a radio link can have, and what it takes.
struct RadioRate {
  double least_dbm = 0.0;  ///< received
  double rate_bit_s = 0.0;
};
/// IEEE 802.11n, 20 MHz, one stream: least sensitivities (table 20-23), and half of the rates for what goes on top.
inline constexpr std::array<RadioRate, 8> kRadioRates = {{{-82.0, 3.25e6},
                                                          {-79.0, 6.5e6},
                                                          {-77.0, 9.75e6},
                                                          {-74.0, 13e6},
                                                          {-70.0, 19.5e6},
                                                          {-66.0, 26e6},
                                                          {-65.0, 29.25e6},
                                                          {-64.0, 32.5e6}}};

/// Log-distance path loss with shadowing, beside line of sight.
struct RadioConditions {
  std::string preset = "none";
  std::optional<double> exponent = {};  ///< of the path loss; none: a link is ideal while there is line of sight
  double power_dbm = 20.0;              ///< with both antennas' gains
  double loss_at_1m_db = 46.4;          ///< free space at 5 GHz
  double shadowing_sigma_db = 4.0;
  double decorrelation_m = 15.0;
  double rate_share = 0.05;  ///< of a link's rate that this fleet's messages get

  bool on() const { return exponent.has_value(); }
};

struct ConditionsConfig {
  std::string preset = "none";  ///< of what no section says otherwise
  WindConditions wind;
  OdometryConditions odometry;
  BatteryConditions battery;
  LidarConditions lidar;
  CameraConditions camera;
  RadioConditions radio;

  bool on() const { return wind.on() || odometry.on() || battery.on() || lidar.on() || camera.on() || radio.on(); }
};

inline constexpr std::array kConditionPresets = {"none", "breezy", "harsh"};

/// @param preset  one of kConditionPresets; another one is taken for "none".
ConditionsConfig conditions_preset(const std::string& preset);

/// Names of the sections, as `--conditions` spells them.
std::vector<std::string> condition_sections();

/// What `--conditions` says: a preset for all ("breezy"), or sections ("wind=harsh,battery=breezy"), or both
/// ("breezy,wind=none"); a "+" is as good as a comma. What it leaves out stays as in `base`.
/// @throws InputError naming a preset or section that does not exist.
ConditionsConfig chosen_conditions(const std::string& text, const ConditionsConfig& base);

/// In the words of `--conditions`: "none", "breezy", "none,wind=harsh"; a section with a value of its own is "own".
std::string conditions_text(const ConditionsConfig& conditions);

}  // namespace skein
