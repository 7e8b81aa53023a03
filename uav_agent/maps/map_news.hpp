// Map sharing: the messages by which UAVs tell each other by radio which cubes of their WorldMaps are free or occupied.
//
// Each UAV of the fleet, explorer or photographer, has a MapNews beside its map. A message is for all UAVs in line of
// sight: a chunk that some of them lack is sent once to all. A message has
//   - news: chunks of the map as one tree in OctoMap's serialisation (map_subtrees.hpp), readable without other
//     messages;
//   - a receipt for each UAV heard recently, which says which of that UAV's messages have arrived: the last one and the
//     32 before it. The content of a lost message is sent again, in its state at that time (told_chunks.hpp);
//   - the place that the sender flies to: the others send it news about the way there first.
// A UAV passes on what others told it, except to the UAV that told it and to UAVs that hear that UAV themselves. A
// restarted program has a new incarnation number. From it the others see that they must tell it everything again.
// News only add to a listener's map, and occupied outweighs free. If a teller vacates a cube (WorldMap::vacate()), the
// cube stays occupied at the listeners until they vacate it, too: that is the safe side. A teller's news make an
// occupied cube free only if the listener doubts it (WorldMap::doubt()) and this teller had reported it occupied.
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
    double bytes_per_s = 20'000.0;  ///< limit of all that a link carries in any second; chosen
    double period_s = 0.2;          ///< least time from one message to the next; chosen
    double idle_period_s = 1.0;     ///< the same if there is neither news to tell nor a message to acknowledge; chosen
    double heard_s = 3.0;           ///< a UAV gets receipts for this long after its last message; chosen
    ToldChunks::Config told = {};
  };
  /// Bytes that a message takes on a link besides its payload's text: CDR header, length, the planner's name and all
  /// else that send_payload() adds. Format.
  static constexpr std::size_t kEnvelopeBytes = 40;

  MapNews(UavIndex self, std::size_t fleet) : MapNews(self, fleet, Config()) {}
  /// @param fleet  at most 65,535 UAVs. Of a larger fleet than Acquaintances::kMostSlots, the UAV shares its map with
  /// as many as it met first, by sight or by a message.
  MapNews(UavIndex self, std::size_t fleet, const Config& config);

  /// Appends a message, if one is due and a UAV is in line of sight. Call it at each exchange. It sends nothing in its
  /// first second: a restarted program does not know how much its predecessor sent in that second.
  /// @param map  the same at each call.   @param going_to_W  place that this UAV flies to, if known.
  /// @returns whether it appended one.
  bool write(const WorldMap& map, const Peers& peers, const std::optional<Vector3d>& going_to_W, Tick now,
             PayloadWriter& writer);
  /// Reads a message of another UAV's write(): enters its news into the map, with the sender as their teller.
  /// @returns false, and changes nothing, if the message is damaged, has cubes of another size, or if the sender is
  /// this UAV or not in the fleet.
  bool read(std::size_t sender, Tick now, WorldMap& map, PayloadReader& reader);

 private:
  struct Receipt {  ///< which messages of `uav` have arrived at the sender of the receipt
    std::size_t uav = 0;
    std::uint32_t incarnation = 0, latest = 0, before = 0;  ///< before: a bit for each of the 32 before `latest`
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
    bool restarted = false;  ///< its present program may not know what its former one told
    std::optional<Vector3d> going_to_W = {};
    Tellers hears = 0;  ///< UAVs that it hears, and that this UAV has heard, too
  };

  static void append(const Message& message, double cell_m, std::size_t fleet, PayloadWriter& writer);
  static std::optional<Message> parse(PayloadReader& reader, double cell_m, std::size_t fleet);
  void start(Tick now);
  bool listens_only(Tick now) const;
  std::size_t allowance(Tick now, std::size_t room) const;
  Other* other_of(std::size_t uav);
  std::vector<ToldChunks::Listener> listeners(const Peers& peers);
  std::vector<Receipt> receipts(Tick now) const;
  std::vector<ToldChunks::News> choose(const WorldMap& map, const std::vector<ToldChunks::Listener>& listeners,
                                       std::size_t bytes, Tick now);
  void receive(std::size_t sender, const Message& message, Tick now);
  void note_number(Other& other, std::uint32_t number);

  const UavIndex self_;
  const Config config_;
  ToldChunks told_;
  Acquaintances met_;
  std::vector<Other> others_;      ///< by slot
  std::uint32_t incarnation_ = 0;  ///< tick of this program's first exchange, plus 1; 0: not begun
  std::uint32_t number_ = 0;       ///< of the last message with news
  bool owes_receipt_ = false;
  std::optional<Tick> written_;
  std::deque<std::pair<Tick, std::size_t>> sent_;  ///< tick and bytes of the messages in the last second
};

}  // namespace skein::agent
