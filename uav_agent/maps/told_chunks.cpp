#include "uav_agent/maps/told_chunks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <tuple>

#include "core/math/vectors.hpp"

namespace skein::agent {
namespace {

constexpr int kRegionCubeBits = WorldMap::kRegionBits + MapLevel::kBlockBits;  // of a region's edge, in cubes
constexpr double kDetour = 0.1;  // chosen: weight of the distance from the listener; nearer places come first

Vector3d middle_W(const Eigen::Vector3i& at, double edge_m) {
  return (at.cast<double>() + Vector3d::Constant(0.5)) * edge_m;
}

}  // namespace

ToldChunks::Account& ToldChunks::account(std::size_t slot) {
  if (slot >= accounts_.size()) {
    accounts_.resize(slot + 1);
    for (Region& region : regions_) region.settled.resize(accounts_.size(), 0);
  }
  Account& account = accounts_[slot];
  account.told.resize(chunks_.size(), 0);
  return account;
}

void ToldChunks::take_regions(const WorldMap& map) {
  for (std::size_t i = regions_.size(); i < map.regions().size(); ++i) {
    Region& region = regions_.emplace_back();
    region.at = map.regions()[i];
    region.chunks.fill(-1);
    region.settled.assign(accounts_.size(), 0);
    region_of_[grid_key(region.at)] = static_cast<std::uint32_t>(i + 1);
  }
}

void ToldChunks::take_changes(const WorldMap& map, Region& region, std::optional<Teller> by) {
  const std::uint64_t before = region.revision;
  region.revision = map.region_changed_at(region.at);
  if (region.revision == before) return;
  const WorldMap::ChunksChangedAt& revisions = map.chunks_changed_at(region.at);
  for (int i = 0; i < WorldMap::kRegionChunks; ++i) {
    const std::uint64_t revision = revisions[static_cast<std::size_t>(i)];
    if (revision <= before) continue;
    const Eigen::Vector3i at = WorldMap::chunk_of(region.at, i);
    if (!within_tree(at)) continue;
    std::int32_t& number = region.chunks[static_cast<std::size_t>(i)];
    if (number < 0) {
      number = static_cast<std::int32_t>(chunks_.size());
      chunks_.push_back({.at = at});
    }
    Chunk& chunk = chunks_[static_cast<std::size_t>(number)];
    if (by && chunk.read_revision == chunk.revision) {
      chunk.tellers |= only(*by);
      chunk.read_revision = revision;
    }
    chunk.revision = revision;
  }
}

void ToldChunks::hear(WorldMap& map, std::span<const HeardCube> cubes, Teller teller) {
  std::vector<Eigen::Vector3i> heard;  // regions of the cubes
  for (const HeardCube& cube : cubes) {
    const Eigen::Vector3i region = shifted(cube.cube, kRegionCubeBits - cube.level);
    if (heard.empty() || heard.back() != region) heard.push_back(region);
  }
  const auto take_all = [&](std::optional<Teller> by) {
    take_regions(map);
    for (const Eigen::Vector3i& region : heard) {
      const std::uint32_t* const number = region_of_.find(grid_key(region));
      if (number != nullptr) take_changes(map, regions_[*number - 1], by);
    }
  };
  take_all(std::nullopt);
  map.hear(cubes, teller);
  take_all(teller);
}

/// If the listener's informed tellers have changed, it may lack chunks that it was to get from them: checks all again.
void ToldChunks::note_informed(const Listener& listener) {
  Account& account = this->account(listener.slot);
  if (account.informed == listener.informed) return;
  account.informed = listener.informed;
  for (Region& region : regions_) region.settled[listener.slot] = 0;
}

ToldChunks::Message* ToldChunks::message(std::uint32_t number) {
  if (number == 0 || number > last_number_ || last_number_ - number >= messages_.size()) return nullptr;
  return &messages_[messages_.size() - 1 - (last_number_ - number)];
}

bool ToldChunks::lacks(const Listener& listener, std::uint32_t chunk) const {
  const Chunk& of = chunks_[chunk];
  if (accounts_[listener.slot].told[chunk] >= of.revision) return false;
  return of.read_revision != of.revision || (of.tellers & ~listener.informed) != 0;
}

bool ToldChunks::due(const Listener& listener, std::uint32_t chunk, Tick now) {
  if (!lacks(listener, chunk)) return false;
  const Chunk& of = chunks_[chunk];
  const Tellers bit = only(teller_of(listener.slot));
  const Message* const last = message(of.sent_in);
  if (last == nullptr || (last->to & bit) == 0) return true;
  const bool lost = of.sent_in <= accounts_[listener.slot].latest && (last->acknowledged & bit) == 0;
  const double patience_s = of.sent_revision == of.revision ? config_.repeat_after_s : config_.settle_s;
  return lost || now - last->tick >= ticks(patience_s);
}

double ToldChunks::key_m(const Listener& listener, const Vector3d& p_W) const {
  return distance_to_segment(p_W, listener.p_W, listener.going_to_W) + kDetour * (p_W - listener.p_W).norm();
}

std::optional<double> ToldChunks::key_m(const Region& region, std::span<const Listener> listeners,
                                        double chunk_m) const {
  const double edge_m = WorldMap::kRegion * chunk_m, half_diagonal_m = 0.5 * std::numbers::sqrt3 * edge_m;
  std::optional<double> least;
  for (const Listener& listener : listeners) {
    if (region.settled[listener.slot] == region.revision) continue;
    const double key = key_m(listener, middle_W(region.at, edge_m)) - (1.0 + kDetour) * half_diagonal_m;
    least = std::min(least.value_or(key), key);
  }
  return least;
}

void ToldChunks::open(Region& region, std::span<const Listener> listeners, Tick now, double chunk_m,
                      std::vector<Candidate>& candidates) {
  Tellers unsettled = 0;
  for (const std::int32_t number : region.chunks) {
    if (number < 0) continue;
    const auto chunk = static_cast<std::uint32_t>(number);
    std::optional<double> least;
    for (const Listener& listener : listeners) {
      if (!lacks(listener, chunk)) continue;
      unsettled |= only(teller_of(listener.slot));
      if (!due(listener, chunk, now)) continue;
      const double known_m = accounts_[listener.slot].told[chunk] > 0 ? config_.known_handicap_m : 0.0;
      const double key = key_m(listener, middle_W(chunks_[chunk].at, chunk_m)) + known_m;
      least = std::min(least.value_or(key), key);
    }
    if (least) candidates.push_back({*least, true, chunk});
  }
  for (const Listener& listener : listeners) {
    if ((unsettled & only(teller_of(listener.slot))) == 0) region.settled[listener.slot] = region.revision;
  }
}

std::optional<ToldChunks::News> ToldChunks::read(const WorldMap& map, std::uint32_t chunk,
                                                 std::span<const Listener> listeners, Tick now) {
  Chunk& of = chunks_[chunk];
  WorldMap::Chunk known;
  map.read(of.at, known);
  of.tellers = 0;
  for (const MapLevel::Known& cube : known) {
    if (cube.space != Space::unknown) of.tellers |= only(cube.teller <= Acquaintances::kMostSlots ? cube.teller : kOwn);
  }
  of.read_revision = of.revision;
  if (std::ranges::none_of(listeners, [&](const Listener& listener) { return due(listener, chunk, now); })) return {};
  return News{chunk, of.revision, subtree_of(of.at, known)};
}

void ToldChunks::visit_due(const WorldMap& map, std::span<const Listener> listeners, Tick now,
                           const std::function<bool(News&&)>& take) {
  take_regions(map);
  for (Region& region : regions_) take_changes(map, region, std::nullopt);
  for (const Listener& listener : listeners) note_informed(listener);
  const double chunk_m = WorldMap::kChunk * map.config().cell_m;
  const auto later = [](const Candidate& a, const Candidate& b) {
    return std::tie(a.key_m, a.is_chunk, a.index) > std::tie(b.key_m, b.is_chunk, b.index);
  };
  std::vector<Candidate> heap, opened;
  for (std::uint32_t i = 0; i < regions_.size(); ++i) {
    if (const auto key = key_m(regions_[i], listeners, chunk_m)) heap.push_back({*key, false, i});
  }
  std::ranges::make_heap(heap, later);
  while (!heap.empty()) {
    const Candidate next = heap.front();
    std::ranges::pop_heap(heap, later);
    heap.pop_back();
    if (next.is_chunk) {
      std::optional<News> news = read(map, next.index, listeners, now);
      if (news && !take(std::move(*news))) return;
      continue;
    }
    opened.clear();
    open(regions_[next.index], listeners, now, chunk_m, opened);
    for (const Candidate& chunk : opened) {
      heap.push_back(chunk);
      std::ranges::push_heap(heap, later);
    }
  }
}

void ToldChunks::sent(std::uint32_t number, std::span<const News> news, std::span<const Listener> listeners, Tick now) {
  if (number != last_number_ + 1) throw std::logic_error("ToldChunks: messages are numbered one by one");
  last_number_ = number;
  if (messages_.size() == kRemembered) messages_.pop_front();
  Message& message = messages_.emplace_back();
  message.tick = now;
  for (const Listener& listener : listeners) message.to |= only(teller_of(listener.slot));
  for (const News& one : news) {
    message.chunks.emplace_back(one.chunk, one.revision);
    chunks_[one.chunk].sent_in = number;
    chunks_[one.chunk].sent_revision = one.revision;
  }
}

void ToldChunks::acknowledge(std::size_t slot, std::uint32_t latest, std::uint32_t before) {
  Account& account = this->account(slot);
  const Tellers bit = only(teller_of(slot));
  account.latest = std::max(account.latest, std::min(latest, last_number_));
  for (std::uint32_t back = 0; back <= std::numeric_limits<std::uint32_t>::digits && back < latest; ++back) {
    if (back > 0 && (before >> (back - 1) & 1U) == 0) continue;
    Message* const got = message(latest - back);
    if (got == nullptr || (got->acknowledged & bit) != 0) continue;
    got->acknowledged |= bit;
    for (const auto& [chunk, revision] : got->chunks) {
      account.told[chunk] = std::max(account.told[chunk], revision);
    }
  }
}

void ToldChunks::forget(std::size_t slot) {
  account(slot) = {.told = std::vector<std::uint64_t>(chunks_.size(), 0)};
  for (Region& region : regions_) region.settled[slot] = 0;
  for (Message& message : messages_) {
    message.to &= ~only(teller_of(slot));
    message.acknowledged &= ~only(teller_of(slot));
  }
}

}  // namespace skein::agent
