// Orders from an external program to a learner, in the memory block that they share. An order stays in force until the
// next one, except for its trigger, which counts once.
// Frames: W world; velocities along the body's heading, level.   Units: SI and radians.   Threads: one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "core/messages/hand_command.hpp"
#include "core/planners/block_layout.hpp"
#include "uav_agent/api/planner.hpp"

namespace skein::agent {

/// Most waypoints in an order. Chosen.
inline constexpr std::size_t kMostWaypoints = 32;

class Orders {
 public:
  /// Adds the arrays of the orders to the block's layout. Call it first. @param prefix  of their names.
  void lay_out(BlockLayout& layout, const std::string& prefix);
  void use(std::byte* block) { block_ = block; }

  /// Whether the block has a new order. @param serial  number of the last order that was carried out.
  bool is_news(std::int64_t serial) const { return this->serial() != serial; }
  std::int64_t serial() const { return serial_.in(block_)[0]; }
  /// Velocity and yaw rate; the gimbal's rates are 0.
  HandCommand velocity() const;
  /// Waypoints in W; empty: the UAV stays where it is.
  std::vector<Waypoint> way() const;
  std::optional<double> yaw() const;  ///< of the body in W; nullopt: not ordered
  GimbalAim gimbal() const;
  bool trigger() const { return trigger_.in(block_)[0] != 0; }

 private:
  enum class Gimbal : std::int8_t { carry_on, rate, angle, look_at };  // as in python/skein/stepping/actions.py

  std::byte* block_ = nullptr;
  BlockArray<std::int64_t> serial_, waypoints_;
  BlockArray<double> velocity_, yaw_rate_, way_, yaw_, gimbal_;
  BlockArray<std::int8_t> turns_, gimbal_kind_, trigger_;
};

}  // namespace skein::agent
