// The environment variables that the launcher sets for a program (docs/how-to.md, docs/ros2.md). Needs no ROS.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>

namespace skein_ros {

struct Setup {
  std::string uav;                                ///< SKEIN_UAV: the member's name
  std::uint64_t run = 0;                          ///< SKEIN_RUN
  std::int64_t exchange_ns = 50'000'000;          ///< SKEIN_EXCHANGE_S: simulated time of one step; 50 ms if unset
  bool explorer = true;                           ///< SKEIN_ROLE is not "photographer": it has a LiDAR
  std::set<std::string> radio_sends = {"/plan"};  ///< SKEIN_RADIO_SENDS: "/x /y"
  std::set<std::string> radio_hears;              ///< SKEIN_RADIO_HEARS: "/x/jurong ..."; "/plan/<uav>" if unset
  std::set<std::string> debug_values;             ///< SKEIN_DEBUG_VALUES: "front plan", of /<uav>/debug/<name>
};

/// nullopt: this process is not a program of a fleet.
std::optional<Setup> setup_of_environment();

}  // namespace skein_ros
