#include "bus/cyclonedds/packing.hpp"

#include <algorithm>
#include <atomic>
#include <span>
#include <utility>

#include "bus/cyclonedds/sockets.h"

namespace skein::bus::cyclonedds {

namespace {

/// Cyclone's write function, which Packing::write() replaces; the same for all sockets.
std::atomic<ddsi_tran_write_fn_t> socket_write = nullptr;

/// The objects whose messages this thread holds back: between hold() and release().
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
  messages_.release(send);
}

void Packing::send(const Target& target, std::vector<std::uint8_t>& bytes) {
  const ddsrt_iovec_t vector{bytes.data(), bytes.size()};
  socket_write.load()(target.connection, &target.locator, 1, &vector, 0);
}

ssize_t Packing::write(ddsi_tran_conn_t connection, const ddsi_locator_t* destination, std::size_t parts,
                       const ddsrt_iovec_t* vectors, std::uint32_t flags) {
  const auto holder = std::ranges::find(holding, connection->m_base.gv, &Packing::domain_);
  if (holder == holding.end()) return socket_write.load()(connection, destination, parts, vectors, flags);
  std::size_t size = 0;
  for (const ddsrt_iovec_t& vector : std::span(vectors, parts)) size += vector.iov_len;
  (*holder)->messages_.add({connection, *destination}, std::span(vectors, parts), send);
  return static_cast<ssize_t>(size);
}

}  // namespace skein::bus::cyclonedds
