#include "core/files/write_whole.hpp"

#include <unistd.h>

#include <cerrno>

namespace skein {

// A write that stops half-way does not set errno, so the loop calls write() again, which reports the reason.
bool write_whole(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) return false;
    if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace skein
