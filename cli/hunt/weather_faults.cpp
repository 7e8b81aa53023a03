#include "cli/hunt/weather_faults.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "cli/hunt/draws.hpp"
#include "core/config/config_node.hpp"
#include "core/text/text.hpp"

namespace skein::cli {
namespace {

/// Data sheets of inspection UAVs allow 12 to 15 m/s (docs/conditions.md).
constexpr double kWithstood_mps = 12.0, kLeastGust_mps = 2.0;
/// Share of the charge that a battery keeps: the usual reserve, and the charge for the flight home.
constexpr double kLeastCharge = 0.4;

/// Parts of the conditions that a drawn fault changes.
std::vector<std::string> parts_on(const ConditionsConfig& conditions) {
  std::vector<std::string> parts;
  if (conditions.wind.on()) parts.emplace_back("wind");
  if (conditions.lidar.on()) parts.emplace_back("lidar");
  if (conditions.camera.on()) parts.emplace_back("camera");
  if (conditions.radio.on()) parts.emplace_back("radio");
  return parts;
}

/// A change of one part, as a fault file has it.
std::string change_of(const std::string& part, RandomStream& draw) {
  const auto drawn = [&draw](double low, double high, double parts) {
    return number_text(in_parts(draw.uniform(low, high), parts));
  };
  if (part == "wind")
    return "{mean_mps: " + drawn(1.0, kWithstood_mps, 1.0) + ", turbulence: " + drawn(0.0, 2.0, 10.0) + "}";
  if (part == "lidar")
    return "{reflectivity: " + drawn(0.05, 0.5, 100.0) + ", clutter_p: " + drawn(0.0, 0.0005, 1e4) + "}";
  if (part == "camera")
    return "{exposure_factor: " + drawn(1.0, 6.0, 10.0) + ", vibration_deg_s: " + drawn(0.0, 5.0, 10.0) + "}";
  return "{power_dbm: " + drawn(-10.0, 20.0, 1.0) + "}";
}

}  // namespace

bool is_possible(const std::string& kind, const ConditionsConfig& conditions) {
  if (kind == "gust") return conditions.wind.on();
  if (kind == "fix_loss") return conditions.odometry.on();
  if (kind == "battery_loss") return conditions.battery.on();
  return kind != "conditions" || !parts_on(conditions).empty();
}

bool is_possible(const Fault& fault, const ConditionsConfig& conditions) {
  const auto* change = std::get_if<ConditionsChange>(&fault.action);
  if (change == nullptr) return is_possible(fault_kind(fault), conditions);
  const std::vector<std::string> parts = parts_on(conditions);
  return std::ranges::all_of(change->values.keys,
                             [&](const std::string& part) { return std::ranges::find(parts, part) != parts.end(); });
}

FaultAction weather_fault(const std::string& kind, const std::string& uav, const ConditionsConfig& conditions,
                          RandomStream& draw) {
  if (kind == "fix_loss") return FixLoss{uav};
  if (kind == "battery_loss") return BatteryLoss{uav, hundredths(draw.uniform(kLeastCharge, 0.9))};
  if (kind == "gust") {
    const double most_mps = std::max(kLeastGust_mps, kWithstood_mps - conditions.wind.mean_mps);
    const double speed_mps = draw.uniform(1.0, most_mps), to = draw.uniform(0.0, 2.0 * std::numbers::pi);
    return Gust{uav, {tenths(speed_mps * std::cos(to)), tenths(speed_mps * std::sin(to)), 0.0}};
  }
  const std::vector<std::string> parts = parts_on(conditions);
  const std::string& part = parts[below(draw, parts.size())];
  return ConditionsChange{parse_config_document("{" + part + ": " + change_of(part, draw) + "}", "").root};
}

}  // namespace skein::cli
