#include "cli/domain_block.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "core/types.hpp"

namespace skein::cli {
namespace {

/// Opens the lock file of a domain, and creates it for all users of the host when it is not there. Opening an existing
/// file with O_CREAT is refused by the kernel when another user owns it, hence the two steps.
int open_lock_file(const std::filesystem::path& file) {
  for (;;) {
    int fd = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (fd >= 0 || errno != ENOENT) return fd;
    fd = ::open(file.c_str(), O_RDONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
    if (fd >= 0) ::fchmod(fd, 0644);  // readable by others whatever the umask
    if (fd >= 0 || errno != EEXIST) return fd;
  }
}

}  // namespace

DomainBlock::DomainBlock(std::optional<int> base, int size, const std::filesystem::path& lock_dir) {
  const int last_base = kLastDomain - size + 1;
  if (last_base < kFirstDomain) {
    throw InputError("the fleet needs " + std::to_string(size) + " DDS domains; Skein has " +
                     std::to_string(kLastDomain - kFirstDomain + 1));
  }
  if (base) {
    const std::string range = "must be within " + std::to_string(kFirstDomain) + ".." + std::to_string(last_base) +
                              " for this fleet of " + std::to_string(size) + " domains";
    if (*base == 0) {
      throw InputError("--domain 0: the first domain is the world's, and every ROS 2 node of this host that was told no "
                       "domain is in 0; it " + range);
    }
    if (*base < 0 || *base > last_base) throw InputError("--domain " + std::to_string(*base) + ": " + range);
    if (!try_lock(*base, size, lock_dir)) {
      throw InputError("--domain " + std::to_string(*base) + ": another fleet of this host uses domains " +
                       std::to_string(*base) + ".." + std::to_string(*base + size - 1) +
                       " or some of them; choose another, or leave --domain out to get a free block");
    }
    return;
  }
  for (int candidate = kFirstDomain; candidate <= last_base; ++candidate) {
    if (try_lock(candidate, size, lock_dir)) return;
  }
  throw InputError("no " + std::to_string(size) + " DDS domains in a row are free; other fleets of this host use them");
}

DomainBlock::~DomainBlock() { unlock(); }

bool DomainBlock::try_lock(int base, int size, const std::filesystem::path& lock_dir) {
  for (int domain = base; domain < base + size; ++domain) {
    const std::filesystem::path file = lock_dir / ("skein-domain-" + std::to_string(domain) + ".lock");
    const int fd = open_lock_file(file);
    if (fd < 0) throw std::system_error(errno, std::generic_category(), file.string());
    locks_.push_back(fd);
    if (::flock(fd, LOCK_EX | LOCK_NB) != 0) {
      unlock();
      return false;
    }
  }
  base_ = base;
  return true;
}

void DomainBlock::unlock() {
  for (const int fd : locks_) ::close(fd);
  locks_.clear();
}

}  // namespace skein::cli
