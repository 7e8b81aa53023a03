// What a browser wants to see of what is too much for everybody: LiDAR points of some UAVs, and one UAV's map.
// It is a lease: the page says it again every few seconds, and what nobody has asked for of late is sent no more.
// Nothing of it reaches the run.   Pure; any thread.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace skein::view {

/// After so long without asking again, of wall time, nobody looks any more. Pages ask three times as often.
inline constexpr std::chrono::seconds kLookLease{6};

/// How much of it is told a second at most, beside what everybody is told: together less than 300 kB for up to 20 UAVs.
struct LookBudget {
  static constexpr std::chrono::milliseconds kPointsPeriod{200};  ///< between two sets of points
  std::size_t points = 0;                                         ///< of all UAVs in one of these
  std::size_t map_bytes_per_s = 0;                                ///< of a UAV's maps
};
/// What everybody is told grows with the fleet, so that large ones have less of this.
LookBudget look_budget(std::size_t uavs);

struct LookOrder {
  std::vector<std::string> lidar = {};  ///< UAVs
  std::string map = {};                 ///< a UAV; empty: none
  bool operator==(const LookOrder&) const = default;
};

/// {"do": "look", "lidar": ["jurong"], "map": "jurong"}; what is not wanted has no key.
std::string text_of(const LookOrder& order);
/// @returns nullopt when the text is none of these, word for word in its keys; for too many names, or longer ones than
/// a UAV can have.
std::optional<LookOrder> read_look_order(std::string_view text);

/// Under these names it is told (Feed::set_cloud()).
std::string lidar_cloud(const std::string& uav);
std::string map_cloud(const std::string& uav);
/// All that an order asks for.
std::vector<std::string> clouds_of(const LookOrder& order);

}  // namespace skein::view
