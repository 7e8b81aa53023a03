// User ids for programs that are not to be trusted (docs/security.md): drawn for each run from a range that nobody is
// given ids of, free when they are taken, and free of processes again when they are given back.   Only for root.
#pragma once

#include <cstddef>
#include <vector>

#include "cli/host/supervisor.hpp"
#include "process/host/host_lock.hpp"

namespace skein::cli {

/// systemd's table of ids has none of these in use, nor has Debian's policy; they exist in a container with 65536 ids
/// too. The id after them is the group of all agents (process/files/closed_to_agents.hpp).
inline constexpr uid_t kFirstAgentUser = 60706, kLastAgentUser = 61182;

/// Ends all processes that run as this user, and those that they start meanwhile.
/// @returns false when some are left: the kernel does not let go of them, or they are not ours to end.
bool end_processes_of(uid_t user);

class UserIds {
 public:
  /// @param count  of ids. @throws InputError when so many are not free.
  explicit UserIds(std::size_t count);
  /// Ends the processes of all of them.
  ~UserIds();
  UserIds(const UserIds&) = delete;
  UserIds& operator=(const UserIds&) = delete;

  UserId at(std::size_t i) const { return ids_.at(i); }
  void end_processes() const;

 private:
  std::vector<UserId> ids_;
  std::vector<HostLock> locks_;  ///< against other runs that have not started anything yet
};

}  // namespace skein::cli
