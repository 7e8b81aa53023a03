#include "comm_router/count_store.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>
#include <type_traits>

namespace skein::router {

static_assert(std::is_trivially_copyable_v<LinkCounts>);

/// What the file begins with.
struct CountStore::Head {
  std::array<char, 8> magic{'s', 'k', 'e', 'i', 'n', 'c', 'n', 't'};
  RunId run = RunId::none;
  bool operator==(const Head&) const = default;
};

CountStore::CountStore(const std::filesystem::path& file, std::size_t nodes, RunId run) : nodes_(nodes) {
  const std::size_t links = nodes * nodes, bytes = sizeof(Head) + links * sizeof(LinkCounts);
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  void* memory = MAP_FAILED;
  int reason = errno;
  // A hole in the file would be filled when it is first written to, and a full disk then ends the process (SIGBUS).
  if (descriptor >= 0 && ::ftruncate(descriptor, static_cast<off_t>(bytes)) != 0) {
    reason = errno;
  } else if (descriptor >= 0 && (reason = ::posix_fallocate(descriptor, 0, static_cast<off_t>(bytes))) == 0) {
    memory = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
    reason = errno;
  }
  if (descriptor >= 0) ::close(descriptor);
  if (memory == MAP_FAILED) throw std::system_error(reason, std::generic_category(), "cannot write " + file.string());
  head_ = static_cast<Head*>(memory);
  counts_ = {reinterpret_cast<LinkCounts*>(head_ + 1), links};
  const Head ours{.run = run};
  if (*head_ == ours) return;
  std::ranges::fill(counts_, LinkCounts{});  // new, or of another run: none of ours
  *head_ = ours;
}

CountStore::~CountStore() { ::munmap(head_, sizeof(Head) + counts_.size_bytes()); }

LinkMatrix<LinkCounts> CountStore::earlier_counts() const {
  std::vector<LinkCounts> counts(counts_.begin(), counts_.end());
  for (LinkCounts& link : counts) {
    link.dropped_fault = link.sent + link.duplicated - link.delivered - link.dropped_no_los - link.dropped_overflow;
  }
  return {nodes_, std::move(counts)};
}

void CountStore::save(const LinkGate& gate, const GatedStep& last) {
  saved_ = gate.counts();
  for (const Delivery& delivery : last.deliveries) {
    const RadioRoute& route = gate.routes()[delivery.route];
    LinkCounts& link = saved_.at(route.source, route.targets[delivery.target].node);
    --link.delivered;
    link.delivered_bytes -= delivery.payload->size();
  }
  std::ranges::copy(saved_.row_major(), counts_.begin());
}

}  // namespace skein::router
