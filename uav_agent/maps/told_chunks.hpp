// The record by which MapNews chooses what to send: which chunks of this UAV's WorldMap each listener knows, and which
// it needs next.
//
// A chunk is always sent whole, in its state at that time. A listener counts as knowing a chunk once it has
// acknowledged the message; a chunk that it has not acknowledged, or that has changed since, is sent again. Chunks
// nearest to a listener or to its way come first; chunks of which it knows nothing come before chunks that it knows in
// part.
// Frame W.   Units: metres, ticks.   Threads: one.   Deterministic: no answer depends on an order in memory.
// Bounded: some 100 bytes for each chunk of the map, and the last kRemembered messages.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "uav_agent/maps/acquaintances.hpp"
#include "uav_agent/maps/map_subtrees.hpp"

namespace skein::agent {

/// A set of tellers (kOwn and other UAVs), as one bit for each Teller.
using Tellers = unsigned __int128;
/// @param slot  of a UAV (acquaintances.hpp).
constexpr Teller teller_of(std::size_t slot) { return static_cast<Teller>(slot + 1); }
constexpr Tellers only(Teller teller) { return Tellers{1} << teller; }

class ToldChunks {
 public:
  struct Config {
    double repeat_after_s = 1.0;   ///< a message that is not acknowledged by then counts as lost; chosen
    double settle_s = 1.0;         ///< least time between two messages with a chunk that keeps changing; chosen
    double known_handicap_m = 12;  ///< added to the distance of a chunk that the listener knows in part; chosen
  };
  static constexpr std::size_t kRemembered = 64;  ///< memory: messages whose content is remembered

  struct Listener {  ///< a UAV in line of sight
    std::size_t slot = 0;
    Vector3d p_W = Vector3d::Zero();
    Vector3d going_to_W = Vector3d::Zero();  ///< place that it flies to; p_W if unknown
    /// Tellers whose news it has already: itself, and the UAVs that both it and this UAV hear.
    Tellers informed = 0;
  };
  struct News {
    std::uint32_t chunk = 0;     ///< index in chunks_
    std::uint64_t revision = 0;  ///< WorldMap::changed_at() of the content
    Subtree subtree;
  };

  explicit ToldChunks(const Config& config) : config_(config) {}

  /// Calls `take` with each chunk that is due for at least one listener, the most urgent first, until it returns false.
  /// @param map  the same at each call.
  void visit_due(const WorldMap& map, std::span<const Listener> listeners, Tick now,
                 const std::function<bool(News&&)>& take);
  /// Call it after a message with these chunks was sent to all listeners.
  /// @param number  of the message.   @throws std::logic_error unless it is one more than that of the last message.
  void sent(std::uint32_t number, std::span<const News> news, std::span<const Listener> listeners, Tick now);
  /// Enters a receipt of a listener.   @param latest  number of the last message that it has received.
  /// @param before  bit i tells whether it has received message latest - 1 - i.
  void acknowledge(std::size_t slot, std::uint32_t latest, std::uint32_t before);
  /// Enters a teller's cubes into the map, and notes that the teller knows all that these cubes change in the map.
  void hear(WorldMap& map, std::span<const HeardCube> cubes, Teller teller);
  /// Call it when a UAV's program was restarted: it has lost all that it was told.
  void forget(std::size_t slot);

 private:
  struct Chunk {
    Eigen::Vector3i at = Eigen::Vector3i::Zero();
    std::uint64_t revision = 0;       ///< WorldMap::changed_at()
    std::uint64_t sent_revision = 0;  ///< revision in the last message that had it
    std::uint64_t read_revision = 0;  ///< revision to which `tellers` belongs
    Tellers tellers = 0;              ///< tellers of its known cubes
    std::uint32_t sent_in = 0;        ///< number of the last message that had it; 0: none
  };
  struct Region {
    Eigen::Vector3i at = Eigen::Vector3i::Zero();
    std::uint64_t revision = 0;
    std::array<std::int32_t, WorldMap::kRegionChunks> chunks;  ///< index in chunks_; -1: nothing is known
    std::vector<std::uint64_t> settled;                        ///< by slot: the last revision that it knows in full
  };
  struct Message {
    Tick tick = 0;
    Tellers to = 0, acknowledged = 0;
    std::vector<std::pair<std::uint32_t, std::uint64_t>> chunks;  ///< index in chunks_, and revision
  };
  struct Account {
    std::vector<std::uint64_t> told;  ///< by chunk: the last revision that it has acknowledged
    std::uint32_t latest = 0;         ///< the last message that it acknowledges
    Tellers informed = 0;             ///< see Listener
  };
  struct Candidate {
    double key_m = 0.0;
    bool is_chunk = false;
    std::uint32_t index = 0;
  };

  /// @returns the account of a slot, made if it is new.
  Account& account(std::size_t slot);
  void take_regions(const WorldMap& map);
  /// Takes over the region's new revisions. @param by  the teller of all that has changed; nullopt: not known.
  void take_changes(const WorldMap& map, Region& region, std::optional<Teller> by);
  void note_informed(const Listener& listener);
  Message* message(std::uint32_t number);
  /// lacks(): whether a listener lacks news of a chunk; due(): whether they are to be sent in the next message.
  bool lacks(const Listener& listener, std::uint32_t chunk) const;
  bool due(const Listener& listener, std::uint32_t chunk, Tick now);
  /// Urgency of a place for a listener; the smallest key comes first.
  double key_m(const Listener& listener, const Vector3d& p_W) const;
  /// Lower bound on the keys of the region's chunks; nullopt if no listener lacks any of them.
  std::optional<double> key_m(const Region& region, std::span<const Listener> listeners, double chunk_m) const;
  void open(Region& region, std::span<const Listener> listeners, Tick now, double chunk_m,
            std::vector<Candidate>& candidates);
  std::optional<News> read(const WorldMap& map, std::uint32_t chunk, std::span<const Listener> listeners, Tick now);

  const Config config_;
  std::vector<Region> regions_;          ///< in the order of WorldMap::regions()
  BlockTable<std::uint32_t> region_of_;  ///< index in regions_, plus 1
  std::vector<Chunk> chunks_;
  std::vector<Account> accounts_;  ///< by slot, of the UAVs met so far
  std::deque<Message> messages_;   ///< the last kRemembered
  std::uint32_t last_number_ = 0;
};

}  // namespace skein::agent
