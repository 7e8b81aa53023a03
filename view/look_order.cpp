#include "view/look_order.hpp"

#include <algorithm>

#include "process/json_text.hpp"

namespace skein::view {
namespace {

constexpr std::size_t kLongestCloudUav = 64;  // [bytes]; in JSON, a name takes 3 more
static_assert(kLongestLook > kMostUavs * (kLongestCloudUav + 3));

/// @returns whether `value` may be a UAV's name; if so, `name` gets it.
bool take_name(const Json& value, std::string& name) {
  if (!value.is_string()) return false;
  name = value.get<std::string>();
  return !name.empty() && name.size() <= kLongestCloudUav;
}

bool take_names(const Json& value, std::vector<std::string>& names) {
  if (!value.is_array() || value.size() > kMostUavs) return false;
  for (const Json& one : value) {
    if (!take_name(one, names.emplace_back())) return false;
  }
  return true;
}

}  // namespace

LookBudget look_budget(std::size_t uavs) {
  constexpr std::size_t kPoints = 2'500, kMapBytes_per_s = 80'000;  // 180 kB/s in all, with 8 bytes per point
  constexpr std::size_t kSmallFleet = 5;
  const std::size_t size = std::max(uavs, kSmallFleet);
  return {kPoints * kSmallFleet / size, kMapBytes_per_s * kSmallFleet / size};
}

std::string text_of(const LookOrder& order) {
  Json json = {{"do", "look"}};
  if (!order.lidar.empty()) json["lidar"] = order.lidar;
  if (!order.map.empty()) json["map"] = order.map;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::optional<LookOrder> read_look_order(std::string_view text) {
  if (text.size() > kLongestLook) return std::nullopt;
  const Json json = parse_json(std::string(text));
  if (!json.is_object() || !json.contains("do") || json["do"] != "look") return std::nullopt;
  LookOrder order;
  for (const auto& [key, value] : json.items()) {
    const bool sound = key == "do" || (key == "lidar" && take_names(value, order.lidar)) ||
                       (key == "map" && take_name(value, order.map));
    if (!sound) return std::nullopt;
  }
  return order;
}

std::string lidar_cloud(const std::string& uav) { return "lidar " + uav; }

std::string map_cloud(const std::string& uav) { return "map " + uav; }

std::vector<std::string> clouds_of(const LookOrder& order) {
  std::vector<std::string> names;
  for (const std::string& uav : order.lidar) names.push_back(lidar_cloud(uav));
  if (!order.map.empty()) names.push_back(map_cloud(order.map));
  return names;
}

}  // namespace skein::view
