// For tests: UAVs that share their world maps (maps/map_news.hpp) by a radio that loses, delays and reorders messages.
// Time advances in exchanges, as in the lock-step.
// Frame W.   Units: SI.   Threads: one.   Deterministic.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/math/random_stream.hpp"
#include "uav_agent/maps/map_news.hpp"

namespace skein::agent::test {

inline constexpr Tick kNewsExchange = 20;  ///< duration of an exchange

struct NewsUav {
  std::unique_ptr<WorldMap> own_map;
  WorldMap* map = nullptr;  ///< own_map, or a map of the test
  std::unique_ptr<MapNews> news;
  Vector3d p_W = Vector3d::Zero();
  std::optional<Vector3d> going_to_W = {};
  struct Sent {
    Tick tick = 0;
    std::size_t bytes = 0;  ///< as a link carries them
  };
  std::vector<Sent> sent = {};

  std::size_t bytes_sent() const;
};

/// Whether each cube that is free at `teller` is free or occupied at `listener`, and each occupied one is occupied.
bool knows_all_of(const WorldMap& listener, const WorldMap& teller);

class NewsRadio {
 public:
  struct Config {
    std::size_t uavs = 2;
    double loss = 0.0;   ///< probability that a message does not arrive at a listener
    int most_delay = 1;  ///< a message takes 1 to most_delay exchanges
    MapNews::Config news = {};
    WorldMap::Config map = {};
  };

  NewsRadio(const Config& config, std::uint64_t seed);

  /// One exchange: messages that are due arrive, and each UAV may send one.
  void exchange();
  /// Restarts a UAV's program: it has an empty map, and knows nothing of the others.
  void restart(std::size_t uav);
  /// Whether all UAVs have the same state of each cube.
  bool agree() const;
  /// The same as the free function, for the maps of two UAVs.
  bool knows_all_of(std::size_t listener, std::size_t teller) const {
    return test::knows_all_of(map(listener), map(teller));
  }
  /// Executes exchanges until agree(), which is checked every 10 exchanges, but no more than `most`.
  /// @returns number of exchanges; `most` also if the UAVs do not agree by then.
  int exchanges_to_agree(int most);
  /// The greatest number of bytes that any UAV sent within one second.
  std::size_t most_bytes_in_a_second() const;

  NewsUav& operator[](std::size_t uav) { return uavs_[uav]; }
  const WorldMap& map(std::size_t uav) const { return *uavs_[uav].map; }
  Tick now() const { return now_; }
  /// Whether UAV `i` (first argument) is linked with UAV `j`, so that `j` hears `i`; by default, all are linked.
  std::function<bool(std::size_t, std::size_t)> linked = [](std::size_t, std::size_t) { return true; };
  /// Callback that may change the bytes of a message when it arrives.
  std::function<void(std::size_t sender, std::vector<std::uint8_t>&)> damage;

 private:
  struct Flying {  ///< a message on its way to one listener
    Tick arrives = 0;
    std::size_t sender = 0, listener = 0;
    std::vector<std::uint8_t> bytes;
  };
  void deliver();

  const Config config_;
  RandomStream random_;
  std::vector<NewsUav> uavs_;
  std::vector<Flying> flying_;
  Tick now_ = 0;
};

/// Calls `visit` with all chunks of a map that have ever changed.
void visit_chunks(const WorldMap& map, const std::function<void(const Eigen::Vector3i&)>& visit);
/// Enters `count` random cubes into a map, with teller kOwn: free ones of all sizes and some occupied ones, within
/// reach_m of about_W along each axis.
void draw_space(WorldMap& map, RandomStream& random, const Vector3d& about_W, double reach_m, int count);

}  // namespace skein::agent::test
