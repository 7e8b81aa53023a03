// Order by which a browser flies a UAV by hand: a command that holds until the next one.   Pure; any thread.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/messages/hand_command.hpp"

namespace skein::view {

/// Bounds of an order: each component of the velocity [m/s]; yaw rate of the body and rates of the gimbal [rad/s]. No
/// UAV of Skein is faster.
inline constexpr double kMostHandMps = 20.0, kMostHandRate = 4.0;

struct FlyOrder {
  std::string uav;
  HandCommand command;
  bool operator==(const FlyOrder&) const = default;
};

/// {"do": "fly", "uav": "jurong", "velocity": [ahead, left, up], "yaw_rate": 0.5, "gimbal": [pitch_rate, yaw_rate]}.
std::string text_of(const FlyOrder& order);
/// @returns nullopt unless the text is exactly such an order: all keys and no others, all numbers finite and within the
/// bounds.
std::optional<FlyOrder> read_fly_order(std::string_view text);

}  // namespace skein::view
