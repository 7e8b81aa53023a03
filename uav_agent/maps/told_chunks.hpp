// Which chunks of a WorldMap the others have been told, and what they need next: the book that MapNews keeps.
//
// A chunk is told whole, as it is at that moment. A listener knows what was in a message once it has acknowledged it;
// what it has not acknowledged is told again, and so is what has changed since. What lies nearest to a listener, or to
// its way, comes first, and where it knows nothing before where it knows something.
// Frame W.   Units: metres, ticks.   Threads: one.   Deterministic: no answer depends on an order in memory.
// Bounded: some 100 bytes a chunk of the map, and the last kRemembered messages.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "uav_agent/maps/map_subtrees.hpp"

namespace skein::agent {

/// A set of UAVs and this one itself, as a bit for each Teller.
using Tellers = unsigned __int128;
inline constexpr std::size_t kMostUavs = 127;
constexpr Teller teller_of(std::size_t uav) { return static_cast<Teller>(uav + 1); }
constexpr Tellers only(Teller teller) { return Tellers{1} << teller; }

class ToldChunks {
 public:
  struct Config {
    double repeat_after_s = 1.0;   ///< a message that is not acknowledged by then counts as lost
    double settle_s = 1.0;         ///< a chunk that changes all the time is told so often
    double known_handicap_m = 12;  ///< news of chunks that a listener knows in part come as if so much farther away
  };
  static constexpr std::size_t kRemembered = 64;

  struct Listener {
    std::size_t uav = 0;
    Vector3d p_W = Vector3d::Zero();
    Vector3d going_to_W = Vector3d::Zero();  ///< p_W if it does not say
    /// What these told of is no news to it: they have it from itself, or it hears them as well as this UAV does.
    Tellers informed = 0;
  };
  struct News {
    std::uint32_t chunk = 0;  ///< in this book
    std::uint64_t revision = 0;
    Subtree subtree;
  };

  ToldChunks(std::size_t fleet, const Config& config);

  /// Calls `take` with chunks that some of the listeners do not know, what is needed soonest first, until it returns
  /// false or there are no more.
  /// @param map  the same at each call.
  void visit_due(const WorldMap& map, std::span<const Listener> listeners, Tick now,
                 const std::function<bool(News&&)>& take);
  /// These have gone out to the listeners.   @param number  of the message: one more than that of the message before.
  void sent(std::uint32_t number, std::span<const News> news, std::span<const Listener> listeners, Tick now);
  /// @param latest  number of the last message that a listener has got.
  /// @param before  whether it has got the one before that, the one before that one, ..., from the lowest bit on.
  void acknowledge(std::size_t uav, std::uint32_t latest, std::uint32_t before);
  /// Takes what somebody told into the map, and notes that whatever is new now is known by that teller.
  void hear(WorldMap& map, std::span<const HeardCube> cubes, Teller teller);
  /// It has lost all that it was told.
  void forget(std::size_t uav);

 private:
  struct Chunk {
    Eigen::Vector3i at = Eigen::Vector3i::Zero();
    std::uint64_t revision = 0;       ///< WorldMap::changed_at()
    std::uint64_t sent_revision = 0;  ///< in its last message
    std::uint64_t read_revision = 0;  ///< of `tellers`
    Tellers tellers = 0;              ///< by whom its cubes are known
    std::uint32_t sent_in = 0;        ///< number of its last message; 0: none
  };
  struct Region {
    Eigen::Vector3i at = Eigen::Vector3i::Zero();
    std::uint64_t revision = 0;
    std::array<std::int32_t, WorldMap::kRegionChunks> chunks;  ///< in chunks_; -1: nothing is known
    std::vector<std::uint64_t> settled;                        ///< by listener: at this revision it knew all of it
  };
  struct Message {
    Tick tick = 0;
    Tellers to = 0, acknowledged = 0;
    std::vector<std::pair<std::uint32_t, std::uint64_t>> chunks;  ///< and their revisions
  };
  struct Account {
    std::vector<std::uint64_t> told;  ///< by chunk: the revision that it knows
    std::uint32_t latest = 0;         ///< the last message that it acknowledges
    Tellers informed = 0;
  };
  struct Candidate {
    double key_m = 0.0;
    bool is_chunk = false;
    std::uint32_t index = 0;
  };

  void take_regions(const WorldMap& map);
  /// @param by  all that has changed was told by this one; else it is to be read.
  void take_changes(const WorldMap& map, Region& region, std::optional<Teller> by);
  void note_informed(const Listener& listener);
  Message* message(std::uint32_t number);
  /// Whether a listener lacks news of a chunk; and whether they are to be told it now.
  bool lacks(const Listener& listener, std::uint32_t chunk) const;
  bool due(const Listener& listener, std::uint32_t chunk, Tick now);
  double key_m(const Listener& listener, const Vector3d& p_W) const;
  /// The least that one of its chunks can have; nullopt when all listeners know all of it.
  std::optional<double> key_m(const Region& region, std::span<const Listener> listeners, double chunk_m) const;
  void open(Region& region, std::span<const Listener> listeners, Tick now, double chunk_m,
            std::vector<Candidate>& candidates);
  std::optional<News> read(const WorldMap& map, std::uint32_t chunk, std::span<const Listener> listeners, Tick now);

  const Config config_;
  std::vector<Region> regions_;          ///< as WorldMap::regions()
  BlockTable<std::uint32_t> region_of_;  ///< in regions_, from 1 on
  std::vector<Chunk> chunks_;
  std::vector<Account> accounts_;  ///< by UAV
  std::deque<Message> messages_;   ///< the last ones
  std::uint32_t last_number_ = 0;
};

}  // namespace skein::agent
