// The processes of this host as /proc tells of them. What is gone, or closed to us, reads as empty.   Threads: any.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace skein::cli {

std::vector<pid_t> all_processes();
/// 0 when it is gone.
pid_t parent_of(pid_t pid);
/// Who debugs it; 0: nobody.
pid_t tracer_of(pid_t pid);
/// Whether a signal made it stand still.
bool has_stopped(pid_t pid);
/// Its short name, as `ps` shows it.
std::string process_name(pid_t pid);
/// @param what "cmdline" or "environ".
std::vector<std::string> words_of(pid_t pid, const std::string& what);
/// Its user ids: real, effective, saved; none of what is dead and only waits for its parent.
std::vector<uid_t> users_of(pid_t pid);
bool belongs_to(pid_t pid, uid_t user);
/// Whether it has the network of this process, not that of a container or of `ip netns`.
bool shares_network(pid_t pid);

}  // namespace skein::cli
