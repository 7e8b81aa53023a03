// User ids for untrusted programs (docs/security.md): drawn at random for each run from a range that no system assigns.
// An id has no processes when it is taken; when it is released, its processes are killed.   Only for root.
#pragma once

#include <cstddef>
#include <vector>

#include "host/supervisor.hpp"
#include "process/host/host_lock.hpp"

namespace skein::cli {

/// The range. Neither systemd's table of ids nor Debian's policy assigns these; they exist also in a container with
/// 65536 ids. The next id is the group of all agents (process/files/closed_to_agents.hpp).
inline constexpr uid_t kFirstAgentUser = 60706, kLastAgentUser = 61182;

/// Kills all processes that run as this user, and those that they start meanwhile.
/// @returns false if some are left, because the kernel does not release them; or if this process is not root, or `user`
///   is not in the range.
bool end_processes_of(uid_t user);

class UserIds {
 public:
  /// @param count  number of ids. @throws InputError when fewer are free.
  explicit UserIds(std::size_t count);
  /// Kills the processes of all these users.
  ~UserIds();
  UserIds(const UserIds&) = delete;
  UserIds& operator=(const UserIds&) = delete;

  UserId at(std::size_t i) const { return ids_.at(i); }
  void end_processes() const;

 private:
  std::vector<UserId> ids_;
  std::vector<HostLock> locks_;  ///< keep other runs from taking an id before it has processes
};

}  // namespace skein::cli
