#include "process/files/closed_to_agents.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace skein {
namespace {

constexpr mode_t kAllBits = 07777;

}  // namespace

bool close_to_agents(const std::filesystem::path& path) {
  if (::geteuid() != 0) return false;
  const int file = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return false;
  struct stat status {};
  bool closed = false;
  const bool is_ours = ::fstat(file, &status) == 0 && (S_ISREG(status.st_mode) || S_ISDIR(status.st_mode));
  const mode_t others = status.st_mode & S_IRWXO, group = (status.st_mode & S_IRWXG) >> 3;
  const bool is_closed = others == 0 || (status.st_gid == kAgentsGroup && group == 0);
  if (is_ours && !is_closed) {
    const bool as_group = group == others && ::fchown(file, static_cast<uid_t>(-1), kAgentsGroup) == 0;
    // fchown() may clear special bits, so the mode is set afterwards. The set-group-ID bit is removed: with it, files
    // that are created in the folder would inherit the group.
    const mode_t taken = as_group ? S_IRWXG | S_ISGID : S_IRWXO;
    closed = ::fchmod(file, status.st_mode & kAllBits & ~taken) == 0;
  }
  ::close(file);
  return closed;
}

}  // namespace skein
