#include "view/fly_order.hpp"

#include <cmath>

#include "process/json_text.hpp"

namespace skein::view {
namespace {

constexpr std::size_t kLongestFlyOrder = 500, kLongestUavName = 100;  ///< a browser may send anything
constexpr const char *kFlyDo = "do", *kFlyWord = "fly", *kFlyUav = "uav", *kFlyVelocity = "velocity",
                     *kFlyYawRate = "yaw_rate", *kFlyGimbal = "gimbal";

/// Sets `number` to `value` if that is a number. @returns whether it is a number from -most to most.
bool take_bounded(const Json& value, double most, double& number) {
  if (!value.is_number()) return false;
  number = value.get<double>();
  return std::isfinite(number) && std::abs(number) <= most;
}

bool is_list_of(const Json& json, const char* key, std::size_t size) {
  return json.contains(key) && json[key].is_array() && json[key].size() == size;
}

}  // namespace

std::string text_of(const FlyOrder& order) {
  const HandCommand& command = order.command;
  Json json = Json::object();
  json[kFlyDo] = kFlyWord;
  json[kFlyUav] = order.uav;
  json[kFlyVelocity] = {command.velocity.x(), command.velocity.y(), command.velocity.z()};
  json[kFlyYawRate] = command.yaw_rate;
  json[kFlyGimbal] = {command.gimbal_pitch_rate, command.gimbal_yaw_rate};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::optional<FlyOrder> read_fly_order(std::string_view text) {
  if (text.size() > kLongestFlyOrder) return std::nullopt;
  const Json json = parse_json(std::string(text));
  if (!json.is_object() || json.size() != 5 || !json.contains(kFlyDo) || json[kFlyDo] != kFlyWord) return std::nullopt;
  if (!json.contains(kFlyUav) || !json[kFlyUav].is_string() || !json.contains(kFlyYawRate)) return std::nullopt;
  if (!is_list_of(json, kFlyVelocity, 3) || !is_list_of(json, kFlyGimbal, 2)) return std::nullopt;
  FlyOrder order{.uav = json[kFlyUav].get<std::string>(), .command = {}};
  if (order.uav.empty() || order.uav.size() > kLongestUavName) return std::nullopt;
  HandCommand& command = order.command;
  bool good = take_bounded(json[kFlyYawRate], kMostHandRate, command.yaw_rate);
  for (int i = 0; i < 3; ++i) good = good && take_bounded(json[kFlyVelocity][i], kMostHandMps, command.velocity[i]);
  good = good && take_bounded(json[kFlyGimbal][0], kMostHandRate, command.gimbal_pitch_rate);
  good = good && take_bounded(json[kFlyGimbal][1], kMostHandRate, command.gimbal_yaw_rate);
  return good ? std::optional(order) : std::nullopt;
}

}  // namespace skein::view
