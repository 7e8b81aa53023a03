// Order by which a browser requests data that is too much to send to all browsers: LiDAR points of some UAVs, and one
// UAV's map. A request is a lease: the page renews it every few seconds; when it expires, the data is no longer sent.
// It has no effect on the run.   Pure; any thread.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/scenario/scenario_reader.hpp"

namespace skein::view {

/// A request expires after this wall time unless it is renewed. Pages renew it three times as often.
inline constexpr std::chrono::seconds kLookLease{6};
/// An order may have the names of a whole fleet [bytes].
inline constexpr std::size_t kLongestLook = kMostUavs * 68;

/// Limits of the requested data. Together with what every browser gets, it is less than 300 kB/s for up to 20 UAVs.
struct LookBudget {
  static constexpr std::chrono::milliseconds kPointsPeriod{200};  ///< from one set of points to the next
  std::size_t points = 0;                                         ///< in one set, of all UAVs together
  std::size_t map_bytes_per_s = 0;                                ///< for the maps of a UAV
};
/// The data that every browser gets grows with the fleet, so larger fleets have a smaller budget for requested data.
LookBudget look_budget(std::size_t uavs);

struct LookOrder {
  std::vector<std::string> lidar = {};  ///< names of UAVs
  std::string map = {};                 ///< name of a UAV; empty: none
  bool operator==(const LookOrder&) const = default;
};

/// {"do": "look", "lidar": ["jurong"], "map": "jurong"}; the key of data that is not requested is left out.
std::string text_of(const LookOrder& order);
/// @returns nullopt unless the text is exactly such an order: known keys only, not too many names, and none longer than
/// a UAV's name may be.
std::optional<LookOrder> read_look_order(std::string_view text);

/// Names under which the data is in the feed (Feed::set_cloud()).
std::string lidar_cloud(const std::string& uav);
std::string map_cloud(const std::string& uav);
/// The names of everything that an order requests.
std::vector<std::string> clouds_of(const LookOrder& order);

}  // namespace skein::view
