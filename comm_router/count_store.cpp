#include "comm_router/count_store.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>
#include <type_traits>
#include <utility>

#include "process/files/nowhere.hpp"

namespace skein::router {

static_assert(std::is_trivially_copyable_v<LinkCounts>);

/// The beginning of the file.
struct CountStore::Head {
  std::array<char, 8> magic{'s', 'k', 'e', 'i', 'n', 'c', 'n', 't'};
  RunId run = RunId::none;
  bool operator==(const Head&) const = default;
};

CountStore::CountStore(const std::filesystem::path& file, std::size_t nodes, RunId run)
    : file_(file),
      counts_(nodes),
      fd_(is_nowhere(file) ? -1 : ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)) {
  if (is_nowhere(file)) return;
  if (fd_ < 0) throw failure();
  Head head;
  const Head ours{.run = run};
  std::vector<LinkCounts> links(nodes * nodes);
  const std::size_t bytes = links.size() * sizeof(LinkCounts);
  const bool whole = ::pread(fd_, &head, sizeof head, 0) == ssize_t{sizeof head} &&
                     ::pread(fd_, links.data(), bytes, sizeof head) == static_cast<ssize_t>(bytes);
  if (whole && head == ours) {
    counts_ = {nodes, std::move(links)};
    return;
  }
  // A new file, or one of another run: all counts begin at 0. Writes the file in full length at once, so that a full
  // disk is noticed before the first count. The head comes last: a router that is killed before leaves a file that is
  // not this run's, and not its head before the counts of another run.
  if (!write(sizeof ours, counts_.row_major().data(), bytes) ||
      ::ftruncate(fd_, static_cast<off_t>(sizeof ours + bytes)) != 0 || !write(0, &ours, sizeof ours)) {
    const std::system_error error = failure();
    ::close(fd_);
    throw error;
  }
}

CountStore::~CountStore() {
  if (fd_ >= 0) ::close(fd_);
}

std::system_error CountStore::failure() const {
  return {errno, std::generic_category(), "cannot write " + file_.string()};
}

bool CountStore::write(std::size_t at, const void* data, std::size_t bytes) {
  const auto* next = static_cast<const char*>(data);
  while (bytes > 0) {
    const ssize_t written = ::pwrite(fd_, next, bytes, static_cast<off_t>(at));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    next += written;
    at += static_cast<std::size_t>(written);
    bytes -= static_cast<std::size_t>(written);
  }
  return true;
}

LinkMatrix<LinkCounts> CountStore::earlier_counts() const {
  std::vector<LinkCounts> counts = counts_.row_major();
  for (LinkCounts& link : counts) {
    link.dropped_fault = link.sent + link.duplicated - link.delivered - link.dropped_no_los - link.dropped_overflow;
  }
  return {counts_.nodes(), std::move(counts)};
}

void CountStore::save(const LinkGate& gate, const GatedStep& last) {
  if (fd_ < 0) return;
  counts_ = gate.counts();
  for (const Delivery& delivery : last.deliveries) {
    const RadioRoute& route = gate.routes()[delivery.route];
    LinkCounts& link = counts_.at(route.source, route.targets[delivery.target].node);
    --link.delivered;
    link.delivered_bytes -= delivery.payload->size();
  }
  if (write(sizeof(Head), counts_.row_major().data(), counts_.row_major().size() * sizeof(LinkCounts))) return;
  write_error_ = failure().what();
  ::close(std::exchange(fd_, -1));
}

}  // namespace skein::router
