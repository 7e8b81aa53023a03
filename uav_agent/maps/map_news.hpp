// What UAVs tell each other of their WorldMaps by radio: what is free and what is occupied.
//
// All of the fleet keep one of these beside their map, explorers and photographers alike. A message is for everybody in
// line of sight: what somebody lacks goes out once and reaches all. It has
//   - news: chunks of the map as one tree in OctoMap's serialisation (map_subtrees.hpp), readable alone;
//   - for each UAV that was heard of late which of its messages arrived: the last one and 32 before. What was lost is
//     told again, as it is then (told_chunks.hpp);
//   - the place that the sender is going to: news of the way there come soonest.
// What others told is passed on, except to the UAV that told it and to those that hear that UAV themselves. A UAV that
// was started anew shows it by another incarnation, on either side: it is told everything again.
// What is told only adds to a listener's map, and occupied outweighs free. A cube that a teller vacates stays occupied
// where it was told before, until the listener vacates it, too: that is the safe side. Only a cube that the listener
// doubts (WorldMap::doubt()) becomes free by what its teller says.
// Frame W.   Units: SI, bytes.   Threads: one.   Deterministic: no clock but `now`.
// Bounded: bytes_per_s in any second, and memory by the size of the map (told_chunks.hpp).
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "uav_agent/api/payload.hpp"
#include "uav_agent/api/peers.hpp"
#include "uav_agent/maps/told_chunks.hpp"

namespace skein::agent {

class MapNews {
 public:
  struct Config {
    double bytes_per_s = 20'000.0;  ///< on each link, in any second, all that goes out counted
    double period_s = 0.2;          ///< from one message to the next
    double idle_period_s = 1.0;     ///< if there is nothing to tell and nothing to acknowledge
    double heard_s = 3.0;           ///< messages of a UAV are acknowledged so long after the last one
    ToldChunks::Config told = {};
  };
  /// What a message takes on a link besides its payload's text: its encoding, its length, the planner's name and what
  /// else send_payload() adds.
  static constexpr std::size_t kEnvelopeBytes = 40;

  MapNews(UavIndex self, std::size_t fleet) : MapNews(self, fleet, Config()) {}
  /// @throws std::invalid_argument for more than kMostUavs.
  MapNews(UavIndex self, std::size_t fleet, const Config& config);

  /// Appends a message, if one is due and somebody is in line of sight. Called at each exchange. In the first second it
  /// says nothing: one that was started anew does not know what it sent before.
  /// @param map  the same at each call.   @param going_to_W  where this UAV is about to fly.
  /// @returns whether it appended one.
  bool write(const WorldMap& map, const Peers& peers, const std::optional<Vector3d>& going_to_W, Tick now,
             PayloadWriter& writer);
  /// Takes in what write() wrote elsewhere: news into the map, with the sender as their teller.
  /// @returns false, and takes nothing, when the message is damaged, of cubes of another size, or from nobody else of
  /// the fleet.
  bool read(std::size_t sender, Tick now, WorldMap& map, PayloadReader& reader);

  /// Of messages that went out while it was in line of sight, as the link carries them.
  std::uint64_t bytes_to(std::size_t uav) const { return others_.at(uav).bytes; }

 private:
  struct Receipt {  ///< what somebody says of the messages of a UAV
    std::size_t uav = 0;
    std::uint32_t incarnation = 0, latest = 0, before = 0;
  };
  struct Message {
    std::uint32_t incarnation = 0;  ///< of the sender; from 1 on
    std::uint32_t number = 0;       ///< from 1 on; 0: without news
    std::vector<Receipt> receipts;
    std::optional<Vector3d> going_to_W;
    std::vector<std::uint8_t> tree;
  };
  struct Other {
    std::uint32_t incarnation = 0;  ///< 0: never heard
    std::uint32_t latest = 0, before = 0;
    Tick heard = 0;
    bool restarted = false;  ///< it may not know what it told before
    std::optional<Vector3d> going_to_W = {};
    Tellers hears = 0;  ///< of those that this UAV has heard, too
    std::uint64_t bytes = 0;
  };

  static void append(const Message& message, double cell_m, PayloadWriter& writer);
  static std::optional<Message> parse(PayloadReader& reader, double cell_m, std::size_t fleet);
  void start(Tick now);
  bool listens_only(Tick now) const;
  std::size_t allowance(Tick now, std::size_t room) const;
  std::vector<ToldChunks::Listener> listeners(const Peers& peers) const;
  std::vector<Receipt> receipts(Tick now) const;
  std::vector<ToldChunks::News> choose(const WorldMap& map, const std::vector<ToldChunks::Listener>& listeners,
                                       std::size_t bytes, Tick now);
  void receive(std::size_t sender, const Message& message, Tick now);

  const UavIndex self_;
  const Config config_;
  ToldChunks told_;
  std::vector<Other> others_;      ///< by UAV
  std::uint32_t incarnation_ = 0;  ///< the tick at which it was started, from 1 on; 0: not yet
  std::uint32_t number_ = 0;       ///< of the last message with news
  bool owes_receipt_ = false;
  std::optional<Tick> written_;
  std::deque<std::pair<Tick, std::size_t>> sent_;  ///< bytes of the last second
};

}  // namespace skein::agent
