#include "uav_agent/maps/map_exchange.hpp"

#include <algorithm>

namespace skein::agent {

void MapExchange::write(const VoxelGrid& grid, const Peers& peers, Tick now, PayloadWriter& writer) {
  const std::size_t count = grid.chunks();
  writer.u32(grid.fingerprint());
  for (std::size_t chunk = 0; chunk < count; ++chunk) writer.u16(grid.chunk_hash(chunk));
  std::vector<const Account*> listeners;
  for (const Peer& peer : peers.all()) {
    const auto found = accounts_.find(peer.uav);
    if (!peer.visible || found == accounts_.end()) continue;
    if (seconds(now - found->second.heard) < config_.forget_s) listeners.push_back(&found->second);
  }
  const auto lacking = [&](std::size_t chunk) {
    return grid.chunk_revision(chunk) > 0 && std::ranges::any_of(listeners, [&](const Account* account) {
             return account->hashes[chunk] != grid.chunk_hash(chunk);
           });
  };
  PayloadWriter chunks;
  std::uint8_t sent = 0;
  std::optional<std::size_t> last;
  for (std::size_t i = 0; i < count && sent < config_.max_chunks; ++i) {
    const std::size_t chunk = (next_chunk_ + i) % count;
    if (!lacking(chunk)) continue;
    if (sent > 0 && chunks.size() + grid.chunk_bytes() > config_.max_bytes) break;
    chunks.u16(static_cast<std::uint16_t>(chunk));
    grid.write_chunk(chunk, chunks);
    ++sent;
    last = chunk;
  }
  if (last) next_chunk_ = (*last + 1) % count;
  writer.u8(sent);
  writer.bytes(chunks.data());
}

bool MapExchange::read(std::size_t sender, Tick now, VoxelGrid& grid, PayloadReader& reader) {
  if (reader.u32() != grid.fingerprint()) return false;
  Account account{{}, now};
  for (std::size_t chunk = 0; chunk < grid.chunks(); ++chunk) account.hashes.push_back(reader.u16());
  const int sent = reader.u8();
  if (!reader.ok()) return false;
  accounts_[sender] = std::move(account);
  for (int i = 0; i < sent; ++i) {
    const std::size_t chunk = reader.u16();
    if (!grid.merge_chunk(chunk, reader)) return false;
  }
  return true;
}

}  // namespace skein::agent
