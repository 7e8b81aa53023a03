// UAVs with a map each that tell each other of it (maps/map_news.hpp) by a radio that loses, delays and mixes up
// messages, in exchanges as of the lock-step. For tests.
// Frame W.   Units: SI.   Threads: one.   Deterministic.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/random_stream.hpp"
#include "uav_agent/maps/map_news.hpp"

namespace skein::agent::test {

inline constexpr Tick kNewsExchange = 20;

struct NewsUav {
  std::unique_ptr<WorldMap> own_map;
  WorldMap* map = nullptr;  ///< own_map, or one that somebody else keeps
  std::unique_ptr<MapNews> news;
  Vector3d p_W = Vector3d::Zero();
  std::optional<Vector3d> going_to_W = {};
  struct Sent {
    Tick tick = 0;
    std::size_t bytes = 0;  ///< on a link
  };
  std::vector<Sent> sent = {};
};

/// Whether one map knows to be free or occupied at least what the other does.
bool knows_all_of(const WorldMap& listener, const WorldMap& teller);

class NewsRadio {
 public:
  struct Config {
    std::size_t uavs = 2;
    double loss = 0.0;
    int most_delay = 1;  ///< exchanges
    MapNews::Config news = {};
    WorldMap::Config map = {};
  };

  NewsRadio(const Config& config, std::uint64_t seed);

  /// What was sent before arrives, and all UAVs write.
  void exchange();
  /// A UAV loses its map and all that it knows of the others.
  void restart(std::size_t uav);
  /// Whether all cubes are the same to all UAVs.
  bool agree() const;
  /// Whether `listener` knows to be free or occupied at least what `teller` does.
  bool knows_all_of(std::size_t listener, std::size_t teller) const {
    return test::knows_all_of(map(listener), map(teller));
  }
  /// Until all agree.   @returns exchanges; `most` if they do not agree by then.
  int exchanges_to_agree(int most);
  /// The most that a UAV sent in any second.
  std::size_t most_bytes_in_a_second() const;

  NewsUav& operator[](std::size_t uav) { return uavs_[uav]; }
  const WorldMap& map(std::size_t uav) const { return *uavs_[uav].map; }
  Tick now() const { return now_; }
  /// Which UAV hears which; all hear all unless a test says otherwise.
  std::function<bool(std::size_t, std::size_t)> linked = [](std::size_t, std::size_t) { return true; };
  /// Changes what a message that is about to arrive says.
  std::function<void(std::size_t sender, std::vector<std::uint8_t>&)> damage;

 private:
  struct Flying {
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

/// Calls `visit` with all chunks of which a map knows something.
void visit_chunks(const WorldMap& map, const std::function<void(const Eigen::Vector3i&)>& visit);
/// Free cubes of all sizes, and some occupied ones, that a UAV knows by itself: some `count`, within `reach_m`.
void draw_space(WorldMap& map, RandomStream& random, const Vector3d& about_W, double reach_m, int count);

}  // namespace skein::agent::test
