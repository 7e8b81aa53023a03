// What a browser wants of a UAV that somebody flies by hand there, until it says something else.   Pure; any thread.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/hand_command.hpp"

namespace skein::view {

/// No faster than that: no UAV of ours is. Each part of a velocity; rates of body and camera.
inline constexpr double kMostHandMps = 20.0, kMostHandRate = 4.0;

struct FlyOrder {
  std::string uav;
  HandCommand command;
  bool operator==(const FlyOrder&) const = default;
};

/// {"do": "fly", "uav": "jurong", "velocity": [ahead, left, up], "yaw_rate": 0.5, "gimbal": [pitch_rate, yaw_rate]}.
std::string text_of(const FlyOrder& order);
/// @returns nullopt when the text is none of these, word for word in its keys; all numbers must be finite and within
/// the bounds.
std::optional<FlyOrder> read_fly_order(std::string_view text);

}  // namespace skein::view
