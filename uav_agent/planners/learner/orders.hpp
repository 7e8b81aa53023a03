// What a program outside tells a learner, in the block that they share. Until the next order the learner goes on with
// what the last one said, but for the trigger.
// Frames: W world, B body's heading, level.   Units: SI and radians.   Threads: one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "core/block_layout.hpp"
#include "core/hand_command.hpp"
#include "uav_agent/api/planner.hpp"

namespace skein::agent {

/// More waypoints than this fit into no order.
inline constexpr std::size_t kMostWaypoints = 32;

class Orders {
 public:
  void lay_out(BlockLayout& layout, const std::string& prefix);
  void use(std::byte* block) { block_ = block; }

  /// Whether there is an order that was not taken. @param serial  of the last that was.
  bool is_news(std::int64_t serial) const { return this->serial() != serial; }
  std::int64_t serial() const { return serial_.in(block_)[0]; }
  /// Velocity and turn, without the gimbal.
  HandCommand velocity() const;
  /// Empty: to stay.
  std::vector<Waypoint> way() const;
  std::optional<double> yaw() const;
  GimbalAim gimbal() const;
  bool trigger() const { return trigger_.in(block_)[0] != 0; }

 private:
  enum class Gimbal : std::int8_t { carry_on, rate, angle, look_at };  // as python/skein/stepping/actions.py has them

  std::byte* block_ = nullptr;
  BlockArray<std::int64_t> serial_, waypoints_;
  BlockArray<double> velocity_, yaw_rate_, way_, yaw_, gimbal_;
  BlockArray<std::int8_t> turns_, gimbal_kind_, trigger_;
};

}  // namespace skein::agent
