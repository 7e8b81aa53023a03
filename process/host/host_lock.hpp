// A named lock that only one process of a network namespace can hold, whichever user starts it. The holder has an
// abstract Unix socket of this name. So there is no lock file, and the kernel releases the lock however the holder
// ends. Linux.   Threads: any.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

namespace skein {

class HostLock {
 public:
  /// Takes the lock until the returned object is destroyed.
  /// @returns nullopt if a process, perhaps this one, holds the lock.
  /// @throws std::invalid_argument if the name is longer than 107 bytes; std::system_error for any other failure.
  static std::optional<HostLock> try_take(const std::string& name);
  /// The process that holds the lock; nullopt if there is none, if it has taken the lock only just now, or if it is not
  /// visible in this process's PID namespace: from within a container, processes outside it are not. Also nullopt
  /// after about 4,096 calls for the same lock (SOMAXCONN) since the holder last called forget_visitors().
  /// Use the result only in messages; to find out whether the lock is free, call try_take().
  static std::optional<pid_t> holder(const std::string& name);

  /// Frees the places in the lock's queue that calls of holder() have taken. A process that holds a lock for long must
  /// call it now and then. Does not wait.
  void forget_visitors() const;

  HostLock(HostLock&& other) noexcept;
  HostLock& operator=(HostLock&& other) noexcept;
  ~HostLock();

 private:
  explicit HostLock(int fd) : fd_(fd) {}

  int fd_ = -1;
};

/// Name of the lock that a fleet holds for each of its DDS domains, so that no other fleet uses the same domain.
std::string domain_lock_name(int domain);

}  // namespace skein
