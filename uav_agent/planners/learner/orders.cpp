#include "uav_agent/planners/learner/orders.hpp"

#include <algorithm>

namespace skein::agent {
namespace {

constexpr std::size_t kWaypointNumbers = 4;  ///< position and speed; format: python/skein/stepping/actions.py

}  // namespace

void Orders::lay_out(BlockLayout& layout, const std::string& prefix) {
  serial_ = layout.add<std::int64_t>(prefix + "serial");
  velocity_ = layout.add<double>(prefix + "velocity", {3});
  yaw_rate_ = layout.add<double>(prefix + "yaw_rate");
  waypoints_ = layout.add<std::int64_t>(prefix + "waypoints");
  way_ = layout.add<double>(prefix + "way", {kMostWaypoints, kWaypointNumbers});
  turns_ = layout.add<std::int8_t>(prefix + "turns");
  yaw_ = layout.add<double>(prefix + "yaw");
  gimbal_kind_ = layout.add<std::int8_t>(prefix + "gimbal_kind");
  gimbal_ = layout.add<double>(prefix + "gimbal", {3});
  trigger_ = layout.add<std::int8_t>(prefix + "trigger");
}

HandCommand Orders::velocity() const {
  const auto v = velocity_.in(block_);
  return {.velocity = {v[0], v[1], v[2]}, .yaw_rate = yaw_rate_.in(block_)[0]};
}

std::vector<Waypoint> Orders::way() const {
  const auto cells = way_.in(block_);
  const auto count = std::clamp<std::int64_t>(waypoints_.in(block_)[0], 0, kMostWaypoints);
  std::vector<Waypoint> way;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const auto row = cells.subspan(kWaypointNumbers * i, kWaypointNumbers);
    way.push_back({{row[0], row[1], row[2]}, row[3]});
  }
  return way;
}

std::optional<double> Orders::yaw() const {
  return turns_.in(block_)[0] != 0 ? std::optional(yaw_.in(block_)[0]) : std::nullopt;
}

GimbalAim Orders::gimbal() const {
  const auto wanted = gimbal_.in(block_);
  switch (static_cast<Gimbal>(gimbal_kind_.in(block_)[0])) {
    case Gimbal::carry_on:
      break;
    case Gimbal::rate:
      return GimbalCommand{GimbalMode::rate, wanted[0], wanted[1]};
    case Gimbal::angle:
      return GimbalCommand{GimbalMode::angle, wanted[0], wanted[1]};
    case Gimbal::look_at:
      return Vector3d(wanted[0], wanted[1], wanted[2]);
  }
  return {};
}

}  // namespace skein::agent
