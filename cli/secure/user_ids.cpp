#include "cli/secure/user_ids.hpp"

#include <grp.h>
#include <poll.h>
#include <pwd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <random>
#include <set>
#include <string>

#include "core/types.hpp"
#include "host/proc_table.hpp"

extern "C" {  // missing in glibc 2.36's header
#include <sys/pidfd.h>
}

namespace skein::cli {
namespace {

/// Longest wait for the end of a killed process.
constexpr int kPatience_ms = 2000;
constexpr int kRounds = 5;

std::vector<pid_t> processes_of(uid_t user) {
  std::vector<pid_t> found = all_processes();
  std::erase_if(found, [&](pid_t pid) { return !belongs_to(pid, user); });
  return found;
}

std::set<uid_t> users_with_processes() {
  std::set<uid_t> users;
  for (const pid_t pid : all_processes()) {
    for (const uid_t user : users_of(pid)) users.insert(user);
  }
  return users;
}

/// Kills all processes of the user in one system call, by a child with that user id: killed one by one, they could fork
/// faster.
void kill_all_of(uid_t user) {
  const pid_t killer = ::fork();
  if (killer == 0) {
    const bool changed = ::setgroups(0, nullptr) == 0 && ::setgid(user) == 0 && ::setuid(user) == 0 &&
                         ::getuid() == user && ::geteuid() == user && user != 0;
    if (changed) ::kill(-1, SIGKILL);  // all that this user may signal, except the caller
    ::_exit(0);
  }
  if (killer > 0) ::waitpid(killer, nullptr, 0);
}

void wait_for_end(pid_t pid) {
  const int fd = ::pidfd_open(pid, 0);
  if (fd < 0) return;
  pollfd polled{fd, POLLIN, 0};
  ::poll(&polled, 1, kPatience_ms);
  ::close(fd);
}

}  // namespace

bool end_processes_of(uid_t user) {
  if (::geteuid() != 0 || user < kFirstAgentUser || user > kLastAgentUser) return false;
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<pid_t> left = processes_of(user);
    if (left.empty()) return true;
    kill_all_of(user);
    for (const pid_t pid : left) wait_for_end(pid);
  }
  return processes_of(user).empty();
}

UserIds::UserIds(std::size_t count) {
  std::vector<uid_t> candidates;
  for (uid_t user = kFirstAgentUser; user <= kLastAgentUser; ++user) candidates.push_back(user);
  // A random order, which does not affect the run: an agent should not own what an earlier agent left in /tmp.
  std::shuffle(candidates.begin(), candidates.end(), std::random_device());
  const std::set<uid_t> taken = users_with_processes();
  for (const uid_t user : candidates) {
    if (ids_.size() == count) return;
    auto lock = HostLock::try_take("skein-user-" + std::to_string(user));
    if (!lock || taken.contains(user) || ::getpwuid(user) != nullptr) continue;
    ids_.push_back({user, user});
    locks_.push_back(std::move(*lock));
  }
  if (ids_.size() < count) {
    throw InputError("--secure: " + std::to_string(count) + " user ids are needed, and only " +
                     std::to_string(ids_.size()) + " within " + std::to_string(kFirstAgentUser) + ".." +
                     std::to_string(kLastAgentUser) + " are free; end other secured runs first");
  }
}

UserIds::~UserIds() { end_processes(); }

void UserIds::end_processes() const {
  for (const UserId& id : ids_) end_processes_of(id.uid);
}

}  // namespace skein::cli
