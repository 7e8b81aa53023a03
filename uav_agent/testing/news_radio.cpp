#include "uav_agent/testing/news_radio.hpp"

#include <algorithm>

namespace skein::agent::test {
namespace {

AgentConfig one_of(std::size_t self, std::size_t uavs) {
  AgentConfig config;
  config.self = UavIndex(self);
  config.fleet.resize(uavs);
  return config;
}

}  // namespace

NewsRadio::NewsRadio(const Config& config, std::uint64_t seed)
    : config_(config), random_(seed, "news_radio", 0), uavs_(config.uavs) {
  for (std::size_t uav = 0; uav < config.uavs; ++uav) restart(uav);
}

void NewsRadio::restart(std::size_t uav) {
  uavs_[uav].own_map = std::make_unique<WorldMap>(config_.map);
  uavs_[uav].map = uavs_[uav].own_map.get();
  uavs_[uav].news = std::make_unique<MapNews>(UavIndex(uav), config_.uavs, config_.news);
}

void NewsRadio::deliver() {
  std::vector<Flying> later;
  for (Flying& one : flying_) {
    if (one.arrives > now_) {
      later.push_back(std::move(one));
      continue;
    }
    if (damage) damage(one.sender, one.bytes);
    PayloadReader reader(one.bytes);
    uavs_[one.listener].news->read(one.sender, now_, *uavs_[one.listener].map, reader);
  }
  flying_ = std::move(later);
}

void NewsRadio::exchange() {
  now_ += kNewsExchange;
  deliver();
  for (std::size_t i = 0; i < uavs_.size(); ++i) {
    std::vector<Neighbour> neighbours;
    for (std::size_t j = 0; j < uavs_.size(); ++j) {
      if (i != j && linked(i, j)) neighbours.push_back({node_of_uav(UavIndex(j)), uavs_[j].p_W});
    }
    Peers peers(one_of(i, uavs_.size()));
    peers.update(now_, neighbours);
    PayloadWriter writer;
    if (!uavs_[i].news->write(*uavs_[i].map, peers, uavs_[i].going_to_W, now_, writer)) continue;
    // As it is serialised: four bytes of the encoding, four of the length, and a NUL.
    uavs_[i].sent.push_back({now_, send_payload("news/1", i, writer).text.size() + 9});
    for (const Neighbour& neighbour : neighbours) {
      if (random_.uniform() < config_.loss) continue;
      const auto delay = 1 + static_cast<Tick>(random_.uniform() * config_.most_delay);
      flying_.push_back({now_ + delay * kNewsExchange, i, *uav_of_node(neighbour.node), writer.data()});
    }
  }
}

bool NewsRadio::agree() const {
  for (std::size_t i = 0; i < uavs_.size(); ++i) {
    for (std::size_t j = 0; j < uavs_.size(); ++j) {
      if (i != j && !knows_all_of(i, j)) return false;
    }
  }
  return true;
}

int NewsRadio::exchanges_to_agree(int most) {
  constexpr int kLook = 10;
  int exchanges = 0;
  while (exchanges < most && (exchanges % kLook != 0 || !agree())) {
    exchange();
    ++exchanges;
  }
  return exchanges;
}

std::size_t NewsUav::bytes_sent() const {
  std::size_t bytes = 0;
  for (const Sent& one : sent) bytes += one.bytes;
  return bytes;
}

std::size_t NewsRadio::most_bytes_in_a_second() const {
  std::size_t most = 0;
  for (const NewsUav& uav : uavs_) {
    for (std::size_t first = 0; first < uav.sent.size(); ++first) {
      std::size_t bytes = 0;
      for (std::size_t i = first; i < uav.sent.size(); ++i) {
        if (uav.sent[i].tick < uav.sent[first].tick + kTicksPerSecond) bytes += uav.sent[i].bytes;
      }
      most = std::max(most, bytes);
    }
  }
  return most;
}

bool knows_all_of(const WorldMap& listener, const WorldMap& teller) {
  bool all = true;
  WorldMap::Chunk known, told;
  visit_chunks(teller, [&](const Eigen::Vector3i& chunk) {
    if (!all) return;
    listener.read(chunk, known);
    teller.read(chunk, told);
    for (std::size_t i = 0; i < known.size(); ++i) all = all && known[i].space >= told[i].space;
  });
  return all;
}

void visit_chunks(const WorldMap& map, const std::function<void(const Eigen::Vector3i&)>& visit) {
  for (const Eigen::Vector3i& region : map.regions()) {
    for (int i = 0; i < 64; ++i) {
      const Eigen::Vector3i chunk = 4 * region + Eigen::Vector3i(i & 3, i >> 2 & 3, i >> 4);
      if (map.changed_at(chunk) > 0) visit(chunk);
    }
  }
}

void draw_space(WorldMap& map, RandomStream& random, const Vector3d& about_W, double reach_m, int count) {
  for (int i = 0; i < count; ++i) {
    const int level = static_cast<int>(random.uniform() * map.levels());
    const bool occupied = level == 0 && random.uniform() < 0.3;
    Vector3d p_W = about_W;
    for (double& along : p_W) along += random.uniform(-reach_m, reach_m);
    const Eigen::Vector3i cube = map.cube_of(p_W);
    map.hear({cube.x() >> level, cube.y() >> level, cube.z() >> level}, level, occupied ? Space::occupied : Space::free,
             kOwn);
  }
}

}  // namespace skein::agent::test
