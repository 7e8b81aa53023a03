// Non-ideal conditions of a run: wind, errors of odometry and LiDAR, image blur, batteries that run empty, radio path
// loss. All are off by default. A run with all of them off is bit-identical to a run without this feature.
// docs/conditions.md has the model of each part, its parameters with their sources, and the presets.
// Units: SI and radians unless the name says otherwise.  Pure; safe from any thread.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace skein {

/// Mean wind with a logarithmic height profile, plus Dryden gusts.
struct WindConditions {
  std::string preset = "none";
  double mean_mps = 0.0;                  ///< mean wind at 10 m above the ground
  std::optional<double> from_deg = {};    ///< direction it blows from; 0: east, 90: north; none: drawn from the seed
  double roughness_length_m = 0.03;       ///< roughness length of the ground in the logarithmic law
  double turbulence = 0.0;                ///< factor on the gust intensities of MIL-F-8785C; 0: no gusts
  double body_drag_area_m2 = 0.03;        ///< drag coefficient times area of the body, rotors excluded
  double estimate_sigma_mps = 0.5;        ///< error of the wind estimate that a UAV gets, per component
  double estimate_time_constant_s = 2.0;  ///< lag of that estimate behind the wind

  bool on() const { return mean_mps > 0.0; }
};

/// Errors of a UAV's odometry: first-order Gauss-Markov processes, a constant offset, and white noise.
struct OdometryConditions {
  std::string preset = "none";
  double horizontal_sigma_m = 0.0, vertical_sigma_m = 0.0;  ///< stationary standard deviation, per axis
  double time_constant_s = 60.0;                            ///< of the horizontal and the vertical error
  double yaw_sigma_deg = 0.0;
  double yaw_time_constant_s = 60.0;
  double bias_sigma_m = 0.0;              ///< standard deviation of a constant offset per axis, drawn once
  double noise_sigma_m = 0.0;             ///< white noise per sample and axis, only in the messages
  double velocity_sigma_mps = 0.0;        ///< white noise per sample and axis, only in the messages
  double latency_s = 0.0;                 ///< delay of the messages, in whole exchanges; stamps have the true time
  std::optional<double> mean_fix_s = {};  ///< mean duration of a position fix; none: the fix is never lost
  double mean_lost_s = 10.0;              ///< mean time from the loss of the fix to the next fix
  double walk_m_per_sqrt_s = 0.1;         ///< random walk per axis while the fix is lost
  bool known_start = false;               ///< until a UAV takes off, its position has no error but bias and noise

  bool on() const {
    return horizontal_sigma_m > 0.0 || vertical_sigma_m > 0.0 || yaw_sigma_deg > 0.0 || bias_sigma_m > 0.0 ||
           noise_sigma_m > 0.0 || velocity_sigma_mps > 0.0 || latency_s > 0.0 || mean_fix_s.has_value();
  }
};

/// Battery model: energy use follows from rotor power; the pack's capacity is given as endurance in hover.
struct BatteryConditions {
  std::string preset = "none";
  std::optional<double> endurance_missions =
      {};                             ///< endurance in hover in still air, in mission durations; none: no battery
  double reserve = 0.2;               ///< share of the charge with which a UAV should land
  double efficiency = 0.55;           ///< ideal rotor power / electric power
  double avionics_w = 15.0;           ///< constant load: computer, camera, LiDAR
  double sag = 0.05;                  ///< relative voltage drop of the pack under the load of hover
  int cells = 6;                      ///< in series
  std::optional<double> swap_s = {};  ///< time on the ground after which a UAV has a full battery; none: never
  double swap_within_m = 100.0;       ///< greatest horizontal distance from the station at which batteries are swapped

  bool on() const { return endurance_missions.has_value(); }
  bool swaps() const { return on() && swap_s.has_value(); }
};

/// Lost returns, range errors and false returns of a LiDAR.
struct LidarConditions {
  std::string preset = "none";
  double sigma_per_m = 0.0;                 ///< range noise per metre of range, on top of the vehicle's sigma_m
  double divergence_mrad = 0.0;             ///< full angle of a beam: on slanted surfaces, it adds range noise
  std::optional<double> reflectivity = {};  ///< of all surfaces at normal incidence; none: no return is lost
  double full_range_m = 100.0;              ///< range at which a perpendicular white surface is just seen
  double clutter_p = 0.0;                   ///< probability that rain or dust returns a beam
  double clutter_mean_m = 4.0;              ///< mean distance of these returns beyond the minimum range; exponential

  bool on() const { return sigma_per_m > 0.0 || divergence_mrad > 0.0 || reflectivity.has_value() || clutter_p > 0.0; }
};

/// Greatest tangent of the incidence angle for the range noise: that of 80 degrees. On thin members, the angle that the
/// ranges of adjacent beams suggest is close to 90 degrees, and the noise would have no bound.
inline constexpr double kMostTanIncidence = 5.671281819617709;

/// Standard deviation of the range noise per metre of range and per tangent of the incidence angle: a quarter of the
/// beam's diameter, which is the standard deviation of a place in an evenly lit disc.
inline double lidar_sigma_across(const LidarConditions& lidar) { return 0.25e-3 * lidar.divergence_mrad; }

/// Standard deviation of the range noise that conditions add [m].
double lidar_sigma_m(const LidarConditions& lidar, double range_m, double tan_incidence);

/// Effects that make pictures worse than the vehicle's file implies.
struct CameraConditions {
  std::string preset = "none";
  double exposure_factor = 1.0;  ///< factor on the vehicle's exposure time: less light
  double vibration_deg_s = 0.0;  ///< standard deviation of each component of an added angular rate, drawn per picture
  double shutter_delay_s = 0.0;  ///< delay from trigger to exposure

  bool on() const { return exposure_factor != 1.0 || vibration_deg_s > 0.0 || shutter_delay_s > 0.0; }
};

/// A data rate of a radio link, and the received power that it requires.
struct RadioRate {
  double least_dbm = 0.0;  ///< least received power
  double rate_bit_s = 0.0;
};
/// Minimum sensitivities of IEEE 802.11n, 20 MHz, one stream (table 20-23). Rates are half the standard's: overhead.
inline constexpr std::array<RadioRate, 8> kRadioRates = {{{-82.0, 3.25e6},
                                                          {-79.0, 6.5e6},
                                                          {-77.0, 9.75e6},
                                                          {-74.0, 13e6},
                                                          {-70.0, 19.5e6},
                                                          {-66.0, 26e6},
                                                          {-65.0, 29.25e6},
                                                          {-64.0, 32.5e6}}};

/// Log-distance path loss with shadowing, in addition to the line-of-sight rule.
struct RadioConditions {
  std::string preset = "none";
  std::optional<double> exponent = {};  ///< path-loss exponent; none: a link with line of sight is ideal
  double power_dbm = 20.0;              ///< transmitted power plus both antennas' gains
  double loss_at_1m_db = 46.4;          ///< free-space loss at 1 m and 5 GHz
  double shadowing_sigma_db = 4.0;
  double decorrelation_m = 15.0;
  double rate_share = 0.05;  ///< share of a link's rate that the fleet's messages get

  bool on() const { return exponent.has_value(); }
};

struct ConditionsConfig {
  std::string preset = "none";  ///< for sections without a preset of their own
  WindConditions wind;
  OdometryConditions odometry;
  BatteryConditions battery;
  LidarConditions lidar;
  CameraConditions camera;
  RadioConditions radio;

  bool on() const { return wind.on() || odometry.on() || battery.on() || lidar.on() || camera.on() || radio.on(); }
};

inline constexpr std::array kConditionPresets = {"none", "breezy", "harsh"};

/// The values of a preset. @param preset  one of kConditionPresets; any other name counts as "none".
ConditionsConfig conditions_preset(const std::string& preset);

/// Names of the sections, as in `--conditions`.
std::vector<std::string> condition_sections();

/// Parses `--conditions`: a preset for all sections ("breezy"), or presets of sections ("wind=harsh,battery=breezy"),
/// or both ("breezy,wind=none"); "+" may replace a comma. A section that is not mentioned stays as in `base`.
/// @throws InputError with the name of an unknown preset or section.
ConditionsConfig chosen_conditions(const std::string& text, const ConditionsConfig& base);

/// The conditions in the syntax of `--conditions`: "none,wind=harsh". A section that differs from its preset is "own".
std::string conditions_text(const ConditionsConfig& conditions);

}  // namespace skein
