#include "process/files/private_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "core/files/write_whole.hpp"

namespace skein {

void write_private_file(const std::filesystem::path& file, std::string_view text) {
  ::unlink(file.c_str());
  const int fd = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, S_IRUSR | S_IWUSR);
  const bool written = fd >= 0 && write_whole(fd, text);
  const int reason = errno;
  if (fd >= 0) ::close(fd);
  if (fd >= 0 && !written) ::unlink(file.c_str());
  if (!written) throw std::system_error(reason, std::generic_category(), file.string());
}

}  // namespace skein
