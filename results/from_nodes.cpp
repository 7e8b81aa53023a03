#include "results/from_nodes.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace skein::results {
namespace {

/// Key in a UAV's entry of result.json; only UAVs that ROS 2 nodes fly in real time have it.
constexpr const char* kFromNodes = "from_nodes";

std::uint64_t count(const Json& topic, const char* key) { return value_or(topic, key, Json(0)).get<std::uint64_t>(); }

}  // namespace

std::vector<std::string> warnings_of_free_nodes(const Json& uavs) {
  std::vector<std::string> warnings;
  for (const Json& uav : uavs) {
    if (!uav.contains(kFromNodes)) continue;
    const auto name = uav["name"].get<std::string>();
    if (uav[kFromNodes].empty()) {
      warnings.push_back(name + ": no ROS 2 node sent anything; `skein run --ros-env " + name +
                         "` prints the environment that a node needs");
    }
    for (const Json& topic : uav[kFromNodes]) {
      if (count(topic, "other_clock") == 0) continue;
      warnings.push_back(
          fmt::format("{}: {} of {} messages on {} have time stamps from another clock; start the nodes with "
                      "use_sim_time:=true",
                      name, count(topic, "other_clock"), count(topic, "received"), topic["topic"].get<std::string>()));
    }
  }
  return warnings;
}

std::string free_nodes_table(const Json& uavs) {
  constexpr std::size_t kLeastWidth = 17;
  std::vector<const Json*> topics;
  std::size_t width = kLeastWidth;
  for (const Json& uav : uavs) {
    if (!uav.contains(kFromNodes)) continue;
    for (const Json& topic : uav[kFromNodes]) {
      topics.push_back(&topic);
      width = std::max(width, topic["topic"].get<std::string>().size());
    }
  }
  if (topics.empty()) return {};
  const auto row = [&](const auto& first, const auto& received, const auto& handed_on, const auto& late,
                       const auto& lost, const auto& refused) {
    return fmt::format("{:<{}}{:>12}{:>12}{:>8}{:>8}{:>10}\n", first, width, received, handed_on, late, lost, refused);
  };
  std::string table = row("from ROS 2 nodes", "received", "handed on", "late", "lost", "refused");
  for (const Json* topic : topics) {
    table += row((*topic)["topic"].get<std::string>(), count(*topic, "received"), count(*topic, "handed_on"),
                 count(*topic, "late"), count(*topic, "lost"), count(*topic, "refused"));
  }
  return table;
}

}  // namespace skein::results
