// What a UAV receives beside its state: uncertainty of its odometry, battery, wind, quality of radio links.
#include <array>
#include <cmath>
#include <limits>

#include "idl/conversions.hpp"

namespace skein {
namespace {

// Indices of the diagonal in a row-major 6 x 6 matrix with the order x, y, z, rotation about X, Y, Z.
constexpr std::array<std::size_t, 3> kPositionVariance = {0, 7, 14};
constexpr std::size_t kYawVariance = 35;

double deviation(double variance) { return variance > 0.0 && std::isfinite(variance) ? std::sqrt(variance) : 0.0; }

}  // namespace

void add_uncertainty(const PoseUncertainty& uncertainty, msg::Odometry& odometry) {
  for (std::size_t axis = 0; axis < kPositionVariance.size(); ++axis) {
    const double sigma_m = uncertainty.position_m[static_cast<Eigen::Index>(axis)];
    odometry.pose().covariance()[kPositionVariance[axis]] = sigma_m * sigma_m;
    odometry.twist().covariance()[kPositionVariance[axis]] = uncertainty.velocity_mps * uncertainty.velocity_mps;
  }
  odometry.pose().covariance()[kYawVariance] = uncertainty.yaw * uncertainty.yaw;
}

PoseUncertainty uncertainty_from_odometry(const msg::Odometry& odometry) {
  PoseUncertainty uncertainty;
  for (std::size_t axis = 0; axis < kPositionVariance.size(); ++axis) {
    uncertainty.position_m[static_cast<Eigen::Index>(axis)] =
        deviation(odometry.pose().covariance()[kPositionVariance[axis]]);
  }
  uncertainty.yaw = deviation(odometry.pose().covariance()[kYawVariance]);
  uncertainty.velocity_mps = deviation(odometry.twist().covariance()[kPositionVariance[0]]);
  return uncertainty;
}

msg::BatteryState to_battery(Tick tick, const BatteryStatus& battery, int cells) {
  constexpr std::uint8_t kDischarging = 2, kGood = 1, kLithiumPolymer = 3;  // as sensor_msgs/msg/BatteryState has them
  msg::BatteryState state;
  state.header(to_header(tick, ""));
  state.voltage(static_cast<float>(battery.voltage_v));
  state.temperature(std::numeric_limits<float>::quiet_NaN());
  state.current(static_cast<float>(-battery.current_a));
  state.charge(static_cast<float>(battery.charge * battery.capacity_ah));
  state.capacity(static_cast<float>(battery.capacity_ah));
  state.design_capacity(static_cast<float>(battery.capacity_ah));
  state.percentage(static_cast<float>(battery.charge));
  state.power_supply_status(kDischarging);
  state.power_supply_health(kGood);
  state.power_supply_technology(kLithiumPolymer);
  state.present(true);
  const auto count = static_cast<std::size_t>(cells);
  state.cell_voltage().assign(count, static_cast<float>(battery.voltage_v / cells));
  return state;
}

std::optional<BatteryStatus> from_battery(const msg::BatteryState& battery) {
  const BatteryStatus status{battery.percentage(), battery.capacity(), battery.voltage(), -battery.current()};
  const bool finite = std::isfinite(status.charge) && std::isfinite(status.capacity_ah) &&
                      std::isfinite(status.voltage_v) && std::isfinite(status.current_a);
  return finite ? std::optional(status) : std::nullopt;
}

msg::TwistStamped to_wind(Tick tick, const Vector3d& wind_W) {
  msg::TwistStamped twist;
  twist.header(to_header(tick));
  twist.twist().linear().x(wind_W.x());
  twist.twist().linear().y(wind_W.y());
  twist.twist().linear().z(wind_W.z());
  return twist;
}

std::optional<Vector3d> from_wind(const msg::TwistStamped& wind) {
  const auto& v = wind.twist().linear();
  const Vector3d wind_W(v.x(), v.y(), v.z());
  return wind_W.allFinite() ? std::optional(wind_W) : std::nullopt;
}

msg::RadioLinks to_radio_links(Tick tick, const LinkQualities& links) {
  msg::RadioLinks message;
  message.header(to_header(tick, ""));
  for (const auto& [node, quality] : links) {
    msg::RadioLink link;
    link.node(static_cast<std::uint32_t>(std::size_t{node}));
    link.received_dbm(static_cast<float>(quality.received_dbm));
    link.rate(static_cast<float>(quality.rate_bit_s));
    message.links().push_back(link);
  }
  return message;
}

LinkQualities from_radio_links(const msg::RadioLinks& links) {
  LinkQualities qualities;
  for (const msg::RadioLink& link : links.links()) {
    if (!std::isfinite(link.received_dbm()) || !std::isfinite(link.rate())) continue;
    qualities.emplace_back(Node(link.node()), LinkQuality{link.received_dbm(), link.rate()});
  }
  return qualities;
}

}  // namespace skein
