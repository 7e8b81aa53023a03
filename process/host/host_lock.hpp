// A name that one process of the host holds at a time. The kernel gives it back when its holder ends, however that
// happens, and nothing is left on disk: it is the name of an abstract Unix socket, so it is the same for all users and
// temporary folders, and as far-reaching as a network namespace. Linux.   Threads: any.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

namespace skein {

class HostLock {
 public:
  /// @returns nullopt when somebody holds it, this process included. @throws std::system_error when the kernel refuses.
  static std::optional<HostLock> try_take(const std::string& name);
  /// Who holds it; nullopt when nobody does, or somebody whom this process cannot see (in another container).
  static std::optional<pid_t> holder(const std::string& name);

  HostLock(HostLock&& other) noexcept;
  HostLock& operator=(HostLock&& other) noexcept;
  ~HostLock();

 private:
  explicit HostLock(int fd) : fd_(fd) {}

  int fd_ = -1;
};

/// What keeps two fleets of a host out of each other's DDS domains.
std::string domain_lock_name(int domain);

}  // namespace skein
