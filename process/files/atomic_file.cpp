#include "process/files/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>

#include "core/files/write_whole.hpp"
#include "process/files/closed_to_agents.hpp"
#include "process/files/nowhere.hpp"

namespace skein {
namespace {

/// A file descriptor that closes itself.
class File {
 public:
  File(const std::string& path, int flags) : fd_(::open(path.c_str(), flags | O_CLOEXEC, 0644)) {}
  ~File() {
    if (fd_ >= 0) ::close(fd_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  bool is_open() const { return fd_ >= 0; }
  bool sync() const { return ::fsync(fd_) == 0; }
  bool write(std::string_view content) const { return write_whole(fd_, content); }
  /// Replaces the content. If there is no room for the new one, the former one stays.
  bool overwrite(std::string_view content) const {
    struct stat former {};
    if (::fstat(fd_, &former) != 0) return false;
    const auto size = static_cast<off_t>(content.size());
    if (const int trouble = size > 0 ? ::posix_fallocate(fd_, 0, size) : 0; trouble != 0) {
      static_cast<void>(!::ftruncate(fd_, former.st_size));
      errno = trouble;
      return false;
    }
    return write(content) && ::ftruncate(fd_, size) == 0;
  }

 private:
  int fd_;
};

/// A new name is durable only after its folder is synced. Some file systems cannot sync folders; that is no failure.
void sync_folder_of(const std::filesystem::path& path) {
  const File folder(path.has_parent_path() ? path.parent_path().string() : ".", O_RDONLY | O_DIRECTORY);
  if (folder.is_open()) static_cast<void>(folder.sync());
}

/// Whether a file that cannot be replaced, for this reason, can perhaps be overwritten.
bool may_stay(const std::error_code& reason) {
  const int code = reason.value();
  return code == EBUSY || code == EACCES || code == EPERM || code == EROFS;
}

}  // namespace

void write_file_atomically(const std::filesystem::path& path, std::string_view content, Readers readers, Flush flush) {
  // The process id prevents two programs that write the same path from sharing a temporary file.
  const std::string temporary = path.string() + ".tmp" + std::to_string(::getpid());
  const auto fail = [&](const char* step) {
    const int reason = errno;
    ::unlink(temporary.c_str());
    throw std::system_error(reason, std::generic_category(), std::string("cannot ") + step + " " + path.string());
  };
  {
    const File file(temporary, O_WRONLY | O_CREAT | O_TRUNC);
    if (!file.is_open()) fail("write");
    if (readers == Readers::no_agents) close_to_agents(temporary);
    if (!file.write(content)) fail("write");
    if (flush == Flush::to_disk && !file.sync()) fail("write");
  }
  if (std::rename(temporary.c_str(), path.c_str()) != 0) fail("rename the temporary file of");
  if (flush == Flush::to_disk) sync_folder_of(path);
}

void put_in_place(const std::filesystem::path& finished, const std::filesystem::path& path) {
  const File file(finished, O_RDONLY);
  if (!file.is_open() || !file.sync() || std::rename(finished.c_str(), path.c_str()) != 0) {
    throw std::system_error(errno, std::generic_category(), "cannot write " + path.string());
  }
  sync_folder_of(path);
}

void replace_or_overwrite(const std::filesystem::path& path, std::string_view content) try {
  write_file_atomically(path, content);
} catch (const std::system_error& error) {
  std::error_code ignored;
  if (!may_stay(error.code()) || !std::filesystem::is_regular_file(path, ignored)) throw;
  const File file(path, O_RDWR);  // if the system cannot reserve room, posix_fallocate() reads the file
  if (file.is_open() && file.overwrite(content) && file.sync()) return;
  throw std::system_error(errno, std::generic_category(), "cannot write " + path.string());
}

std::string write_if_possible(const std::filesystem::path& path, std::string_view content) try {
  if (is_nowhere(path)) return {};
  write_file_atomically(path, content);
  return {};
} catch (const std::system_error& error) {
  return error.what();
}

}  // namespace skein
