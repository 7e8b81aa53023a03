#include "recording/mcap/output.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace skein::mcap {

Output::Output(const std::filesystem::path& file)
    : file_(file), fd_(::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_TRUNC, 0644)) {
  if (fd_ < 0) throw std::system_error(errno, std::generic_category(), "cannot write " + file.string());
}

Output::~Output() { ::close(fd_); }

void Output::write(ByteView records) {
  if (!write_error_.empty()) return;
  for (ByteView left = records; !left.empty();) {
    const ssize_t written = ::write(fd_, left.data(), left.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      write_error_ = "cannot write " + file_.string() + ": " + std::generic_category().message(errno);
      static_cast<void>(!::ftruncate(fd_, static_cast<off_t>(size_)));
      return;
    }
    left = left.subspan(static_cast<std::size_t>(written));
  }
  size_ += records.size();
  crc_ = crc_of(records, crc_);
}

}  // namespace skein::mcap
