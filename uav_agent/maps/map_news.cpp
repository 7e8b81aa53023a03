#include "uav_agent/maps/map_news.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace skein::agent {
namespace {

constexpr double kMostGoingM = std::numeric_limits<std::int16_t>::max();  // metres in a message
constexpr std::uint32_t kWindow = 32;  // format: messages that a receipt covers besides the last one
// Chosen as an estimate: bytes of the nodes above a chunk, shared with its neighbours.
constexpr std::size_t kBytesAboveChunk = 4;
constexpr std::size_t kBytesAboveChunks = 48;  // chosen as an estimate: bytes of the nodes up to the root

// Format: a message has whole millimetres.
std::uint16_t millimetres(double cell_m) { return static_cast<std::uint16_t>(std::lround(1000.0 * cell_m)); }

std::uint16_t whole_metres(double metres) {
  return static_cast<std::uint16_t>(
      static_cast<std::int16_t>(std::lround(std::clamp(metres, -kMostGoingM, kMostGoingM))));
}

/// Whether a byte has room for the number of each UAV.
bool has_short_numbers(std::size_t fleet) { return fleet <= std::numeric_limits<std::uint8_t>::max() + 1U; }

std::size_t link_bytes(const PayloadWriter& payload) { return MapNews::kEnvelopeBytes + text_bytes(payload.data()); }

std::vector<std::uint8_t> tree_of(const std::vector<ToldChunks::News>& news) {
  std::vector<Subtree> subtrees;
  subtrees.reserve(news.size());
  for (const ToldChunks::News& one : news) subtrees.push_back(one.subtree);
  return join_subtrees(subtrees);
}

}  // namespace

MapNews::MapNews(UavIndex self, std::size_t fleet, const Config& config)
    : self_(self), config_(config), told_(config.told), met_(fleet), others_(met_.slots()) {}

void MapNews::append(const Message& message, double cell_m, std::size_t fleet, PayloadWriter& writer) {
  writer.u16(millimetres(cell_m));
  writer.u32(message.incarnation);
  writer.u32(message.number);
  writer.u8(static_cast<std::uint8_t>(message.receipts.size() << 1 | (message.going_to_W ? 1U : 0U)));
  for (const Receipt& receipt : message.receipts) {
    const bool is_short = has_short_numbers(fleet);
    is_short ? writer.u8(static_cast<std::uint8_t>(receipt.uav)) : writer.u16(static_cast<std::uint16_t>(receipt.uav));
    writer.u32(receipt.incarnation);
    writer.u32(receipt.latest);
    writer.u32(receipt.before);
  }
  if (message.going_to_W) {
    for (const double metres : *message.going_to_W) writer.u16(whole_metres(metres));
  }
  if (message.number == 0) return;
  writer.u16(static_cast<std::uint16_t>(message.tree.size()));
  writer.bytes(message.tree);
}

std::optional<MapNews::Message> MapNews::parse(PayloadReader& reader, double cell_m, std::size_t fleet) {
  if (reader.u16() != millimetres(cell_m)) return std::nullopt;
  Message message;
  message.incarnation = reader.u32();
  message.number = reader.u32();
  const unsigned flags = reader.u8();
  for (unsigned i = 0; i < flags >> 1; ++i) {
    Receipt receipt;
    receipt.uav = has_short_numbers(fleet) ? reader.u8() : reader.u16();
    receipt.incarnation = reader.u32();
    receipt.latest = reader.u32();
    receipt.before = reader.u32();
    if (receipt.uav >= fleet) return std::nullopt;
    message.receipts.push_back(receipt);
  }
  if ((flags & 1U) != 0) {
    message.going_to_W.emplace();
    for (double& metres : *message.going_to_W) metres = static_cast<std::int16_t>(reader.u16());
  }
  if (message.number > 0) {
    const std::span<const std::uint8_t> tree = reader.bytes(reader.u16());
    message.tree.assign(tree.begin(), tree.end());
  }
  const bool sound = reader.ok() && message.incarnation > 0 && message.tree.empty() == (message.number == 0);
  return sound ? std::optional(std::move(message)) : std::nullopt;
}

void MapNews::start(Tick now) {
  if (incarnation_ == 0) incarnation_ = static_cast<std::uint32_t>(now) + 1;
}

bool MapNews::listens_only(Tick now) const {
  const bool just_started = now - (static_cast<Tick>(incarnation_) - 1) < kTicksPerSecond;
  return just_started || (written_ && now - *written_ < ticks(config_.period_s));
}

/// Bytes that may be sent now: at most what is left of the last second's limit, and what has accrued since the last
/// message.
std::size_t MapNews::allowance(Tick now, std::size_t room) const {
  double left = config_.bytes_per_s;
  for (const auto& [tick, bytes] : sent_) {
    if (tick > now - kTicksPerSecond) left -= static_cast<double>(bytes);
  }
  const double since_s = written_ ? std::min(seconds(now - *written_), 1.0) : config_.period_s;
  left = std::max(0.0, std::min(left, config_.bytes_per_s * since_s));
  return std::min(static_cast<std::size_t>(left), room);
}

/// @returns nullptr if there is no slot left for this UAV.
MapNews::Other* MapNews::other_of(std::size_t uav) {
  const std::optional<std::size_t> slot = met_.meet(uav);
  others_.resize(met_.slots());
  return slot ? &others_[*slot] : nullptr;
}

std::vector<ToldChunks::Listener> MapNews::listeners(const Peers& peers) {
  std::vector<ToldChunks::Listener> listeners;
  for (const Peer& peer : peers.all()) {
    if (!peer.visible || peer.uav >= met_.fleet()) continue;
    const Other* const other = other_of(peer.uav);
    if (other == nullptr) continue;
    const std::size_t slot = *met_.slot_of(peer.uav);
    const Tellers itself = other->restarted ? 0 : only(teller_of(slot));
    listeners.push_back({slot, peer.p_W, other->going_to_W.value_or(peer.p_W), itself | other->hears});
  }
  return listeners;
}

std::vector<MapNews::Receipt> MapNews::receipts(Tick now) const {
  std::vector<Receipt> receipts;
  for (std::size_t slot = 0; slot < others_.size(); ++slot) {
    const Other& other = others_[slot];
    if (other.incarnation == 0 || now - other.heard > ticks(config_.heard_s)) continue;
    receipts.push_back({met_.uav_of(slot), other.incarnation, other.latest, other.before});
  }
  return receipts;
}

std::vector<ToldChunks::News> MapNews::choose(const WorldMap& map, const std::vector<ToldChunks::Listener>& listeners,
                                              std::size_t bytes, Tick now) {
  std::vector<ToldChunks::News> news;
  if (bytes <= kBytesAboveChunks) return news;
  std::size_t taken = kBytesAboveChunks;
  told_.visit_due(map, listeners, now, [&](ToldChunks::News&& one) {
    taken += kBytesAboveChunk + text_bytes(one.subtree.bytes);
    if (taken > bytes || news.size() == kMostJoined) return false;
    news.push_back(std::move(one));
    return true;
  });
  return news;
}

bool MapNews::write(const WorldMap& map, const Peers& peers, const std::optional<Vector3d>& going_to_W, Tick now,
                    PayloadWriter& writer) {
  start(now);
  if (listens_only(now)) return false;
  const std::vector<ToldChunks::Listener> listeners = this->listeners(peers);
  if (listeners.empty()) return false;
  const std::size_t allowed = allowance(now, writer.room());
  Message message{incarnation_, 0, receipts(now), going_to_W, {}};
  PayloadWriter payload;
  append(message, map.config().cell_m, met_.fleet(), payload);
  const std::size_t bare = link_bytes(payload);
  if (bare > allowed) return false;
  std::vector<ToldChunks::News> news = choose(map, listeners, allowed - bare, now);
  for (; !news.empty(); news.pop_back()) {
    message.number = number_ + 1;
    message.tree = tree_of(news);
    payload = {};
    append(message, map.config().cell_m, met_.fleet(), payload);
    if (link_bytes(payload) <= allowed) break;
  }
  if (news.empty()) {
    const bool idle = !owes_receipt_ && written_ && now - *written_ < ticks(config_.idle_period_s);
    if (idle) return false;
    message.number = 0;
    payload = {};
    append(message, map.config().cell_m, met_.fleet(), payload);
  } else {
    told_.sent(++number_, news, listeners, now);
  }
  writer.bytes(payload.data());
  while (!sent_.empty() && sent_.front().first <= now - kTicksPerSecond) sent_.pop_front();
  sent_.emplace_back(now, link_bytes(payload));
  written_ = now;
  owes_receipt_ = false;
  return true;
}

/// Notes that a message of this number has arrived from another UAV.
void MapNews::note_number(Other& other, std::uint32_t number) {
  owes_receipt_ = true;
  if (number > other.latest) {
    const std::uint32_t ahead = number - other.latest;
    other.before = ahead > kWindow ? 0 : static_cast<std::uint32_t>(std::uint64_t{other.before} << ahead);
    if (ahead <= kWindow && other.latest > 0) other.before |= std::uint32_t{1} << (ahead - 1);
    other.latest = number;
  } else if (const std::uint32_t behind = other.latest - number; behind > kWindow) {
    other.latest = number;  // no message is that late: the former number was damaged
    other.before = 0;
  } else if (behind > 0) {
    other.before |= std::uint32_t{1} << (behind - 1);
  }
}

/// Notes which message of the sender has arrived, and evaluates the sender's receipts.
/// @param sender  slot of the sender.
void MapNews::receive(std::size_t sender, const Message& message, Tick now) {
  Other& other = others_[sender];
  if (other.incarnation != message.incarnation) {
    other.restarted = other.incarnation != 0;
    other.incarnation = message.incarnation;
    other.latest = other.before = 0;
    told_.forget(sender);
  }
  other.heard = now;
  other.going_to_W = message.going_to_W;
  other.hears = 0;
  for (const Receipt& receipt : message.receipts) {
    if (receipt.uav == self_) {
      const bool of_mine = receipt.incarnation == incarnation_ && receipt.latest <= number_;
      if (of_mine) told_.acknowledge(sender, receipt.latest, receipt.before);
    } else if (const auto slot = met_.slot_of(receipt.uav); slot && *slot != sender) {
      const Other& third = others_[*slot];
      const bool same = third.incarnation == receipt.incarnation && !third.restarted;
      if (same) other.hears |= only(teller_of(*slot));
    }
  }
  if (message.number > 0) note_number(other, message.number);
}

bool MapNews::read(std::size_t sender, Tick now, WorldMap& map, PayloadReader& reader) {
  if (sender == self_ || sender >= met_.fleet()) return false;
  const std::optional<Message> message = parse(reader, map.config().cell_m, met_.fleet());
  if (!message) return false;
  const auto cubes = read_subtrees(message->tree, map.levels());
  if (!cubes) return false;
  start(now);
  if (other_of(sender) == nullptr) return true;  // shares its map with as many others already
  const std::size_t slot = *met_.slot_of(sender);
  told_.hear(map, *cubes, teller_of(slot));
  receive(slot, *message, now);
  return true;
}

}  // namespace skein::agent
