// A named lock that one process of the host holds at a time. The lock is the name of an abstract Unix socket: the
// kernel releases it when its holder ends in any way, it leaves no file, and it is valid for all users of the same
// network namespace. Linux.   Threads: any.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

namespace skein {

class HostLock {
 public:
  /// @returns nullopt if a process, perhaps this one, holds the lock. @throws std::system_error for any other failure.
  static std::optional<HostLock> try_take(const std::string& name);
  /// The process that holds the lock; nullopt if there is none, or this process cannot see it (in another container).
  static std::optional<pid_t> holder(const std::string& name);

  HostLock(HostLock&& other) noexcept;
  HostLock& operator=(HostLock&& other) noexcept;
  ~HostLock();

 private:
  explicit HostLock(int fd) : fd_(fd) {}

  int fd_ = -1;
};

/// Name of the lock that a fleet takes for a DDS domain, so that no other fleet of the host uses the domain.
std::string domain_lock_name(int domain);

}  // namespace skein
