#include "process/files/stream_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "process/files/nowhere.hpp"

namespace skein {
namespace {

constexpr std::size_t kBlock = 8192;

}  // namespace

StreamFile::StreamFile(const std::filesystem::path& file, Mode mode) : file_(file) {
  if (is_nowhere(file)) return;
  fd_ = ::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_APPEND | (mode == Mode::fresh ? O_TRUNC : 0), 0644);
  if (fd_ < 0) throw std::system_error(errno, std::generic_category(), "cannot write " + file.string());
}

StreamFile::~StreamFile() {
  flush();
  if (kept()) ::close(fd_);
}

StreamFile& StreamFile::operator<<(std::string_view text) {
  if (!kept() || !write_error_.empty()) return *this;
  buffer_ += text;
  if (buffer_.size() >= kBlock) flush();
  return *this;
}

void StreamFile::flush() {
  const std::size_t taken = put_out();
  if (taken < buffer_.size()) {
    write_error_ = "cannot write " + file_.string() + ": " + std::generic_category().message(errno);
    // A truncated line could pass for a complete line with a shorter last number.
    const std::size_t line_end = taken == 0 ? std::string::npos : buffer_.rfind('\n', taken - 1);
    const std::size_t torn = taken - (line_end == std::string::npos ? 0 : line_end + 1);
    const off_t size = ::lseek(fd_, 0, SEEK_END);
    if (size >= 0) static_cast<void>(!::ftruncate(fd_, size - static_cast<off_t>(torn)));
  }
  buffer_.clear();
}

std::size_t StreamFile::put_out() const {
  std::size_t taken = 0;
  while (taken < buffer_.size()) {
    const ssize_t written = ::write(fd_, buffer_.data() + taken, buffer_.size() - taken);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) break;
    taken += static_cast<std::size_t>(written);
  }
  return taken;
}

}  // namespace skein
