#include "bus/cyclonedds/packing.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <span>
#include <utility>

#include "bus/cyclonedds/sockets.h"

namespace skein::bus::cyclonedds {

namespace {

constexpr std::size_t kHeaderSize = 20;  // RTPS message: protocol, version, vendor, GUID prefix

/// What a message said about its destination must not hold for the one that is put behind it: INFO_DST, to nobody in
/// particular.
constexpr std::array<std::uint8_t, 16> kToAnybody = {0x0e, 0x01, 12, 0};

/// What Cyclone had in our place; one function for all sockets.
std::atomic<ddsi_tran_write_fn_t> socket_write = nullptr;

/// Participants of this thread that hold back.
thread_local std::vector<Packing*> holding;

}  // namespace

void Packing::install(const ddsi_sertype* type) {
  auto* domain = static_cast<ddsi_domaingv*>(ddsrt_atomic_ldvoidp(&type->gv));
  if (domain == domain_) return;
  domain_ = domain;
  std::size_t count = 0;
  ddsi_tran_conn* const* const sockets = skein_cyclone_sockets(domain, &count);
  for (ddsi_tran_conn* connection : std::span(sockets, count)) {
    if (connection->m_stream || connection->m_write_fn == write) continue;
    socket_write = connection->m_write_fn;
    std::atomic_ref(connection->m_write_fn).store(write);
  }
}

void Packing::hold() {
  if (std::exchange(holding_, true)) return;
  holding.push_back(this);
}

void Packing::release() {
  if (!std::exchange(holding_, false)) return;
  std::erase(holding, this);
  for (Datagram& datagram : datagrams_) send(datagram);
}

void Packing::send(Datagram& datagram) {
  if (datagram.bytes.empty()) return;
  const ddsrt_iovec_t vector{datagram.bytes.data(), datagram.bytes.size()};
  socket_write.load()(datagram.connection, &datagram.destination, 1, &vector, 0);
  datagram.bytes.clear();
}

ssize_t Packing::write(ddsi_tran_conn_t connection, const ddsi_locator_t* destination, std::size_t parts,
                       const ddsrt_iovec_t* vectors, std::uint32_t flags) {
  const auto holder = std::ranges::find(holding, connection->m_base.gv, &Packing::domain_);
  if (holder == holding.end()) return socket_write.load()(connection, destination, parts, vectors, flags);
  std::size_t size = 0;
  for (const ddsrt_iovec_t& vector : std::span(vectors, parts)) size += vector.iov_len;
  (*holder)->add(connection, *destination, parts, vectors, size);
  return static_cast<ssize_t>(size);
}

void Packing::add(ddsi_tran_conn_t connection, const ddsi_locator_t& destination, std::size_t parts,
                  const ddsrt_iovec_t* vectors, std::size_t size) {
  auto found = std::ranges::find_if(datagrams_, [&](const Datagram& d) {
    return d.connection == connection && std::memcmp(&d.destination, &destination, sizeof destination) == 0;
  });
  if (found == datagrams_.end()) found = datagrams_.insert(found, {connection, destination, {}});
  std::vector<std::uint8_t>& bytes = found->bytes;
  // Another participant of this process in the same domain has another header.
  const bool fits = bytes.size() + size <= largest_ && vectors[0].iov_len >= kHeaderSize &&
                    std::equal(bytes.begin(), bytes.begin() + static_cast<long>(std::min(bytes.size(), kHeaderSize)),
                               static_cast<const std::uint8_t*>(vectors[0].iov_base));
  if (!fits) send(*found);
  const bool first = bytes.empty();
  if (!first) bytes.insert(bytes.end(), kToAnybody.begin(), kToAnybody.end());
  std::size_t skip = first ? 0 : kHeaderSize;
  for (const ddsrt_iovec_t& vector : std::span(vectors, parts)) {
    const auto* data = static_cast<const std::uint8_t*>(vector.iov_base);
    const std::size_t skipped = std::min<std::size_t>(skip, vector.iov_len);
    bytes.insert(bytes.end(), data + skipped, data + vector.iov_len);
    skip -= skipped;
  }
}

}  // namespace skein::bus::cyclonedds
