#include "core/files/file_bytes.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <memory>
#include <system_error>

#include "core/types.hpp"

namespace skein {

std::string read_file_bytes(const std::filesystem::path& file, std::uintmax_t most_bytes) {
  const auto refuse = [&](const std::string& why) { return InputError(file.string() + ": " + why); };
  // Opening a pipe without a writer must not block this program. So the file is opened with O_NONBLOCK, and its kind is
  // checked before it is read.
  const int fd = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (fd < 0) {
    const int reason = errno;
    if (reason == ENOENT || reason == ENOTDIR) throw refuse("no such file");
    throw refuse(reason == ENXIO ? "not a regular file"
                                 : "cannot be read (" + std::generic_category().message(reason) + ")");
  }
  const std::unique_ptr<const int, void (*)(const int*)> closing(&fd, [](const int* open) { ::close(*open); });
  struct stat status {};
  if (::fstat(fd, &status) != 0 || !S_ISREG(status.st_mode)) throw refuse("not a regular file");
  const auto size = static_cast<std::uintmax_t>(status.st_size);
  if (size > most_bytes) {
    const bool in_mb = most_bytes >= 1 << 20;
    const auto amount = [&](std::uintmax_t bytes) {
      return std::to_string(bytes >> (in_mb ? 20 : 10)) + (in_mb ? " MB" : " kB");
    };
    throw refuse("has " + amount(size) + ", more than the " + amount(most_bytes) + " that are accepted");
  }
  std::string bytes(static_cast<std::size_t>(size), '\0');
  for (std::size_t taken = 0; taken < bytes.size();) {
    const ssize_t got = ::read(fd, bytes.data() + taken, bytes.size() - taken);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) throw refuse("cannot be read");
    taken += static_cast<std::size_t>(got);
  }
  return bytes;
}

std::ifstream open_text(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    throw InputError(file.string() + ": not a regular file");
  }
  return std::ifstream(file);
}

bool next_line(std::istream& in, std::string& line, const std::filesystem::path& file) {
  constexpr std::size_t kLongest = 1 << 20;
  constexpr int kEnd = std::istream::traits_type::eof();
  line.clear();
  if (!in) return false;
  for (int c = in.rdbuf()->sbumpc(); c != '\n'; c = in.rdbuf()->sbumpc()) {
    if (c == kEnd) {
      in.setstate(line.empty() ? std::ios::eofbit | std::ios::failbit : std::ios::eofbit);
      return !line.empty();
    }
    if (line.size() == kLongest) throw InputError(file.string() + ": has a line of more than 1 MB: it is not text");
    line += static_cast<char>(c);
  }
  if (line.ends_with('\r')) line.pop_back();
  return true;
}

}  // namespace skein
