// Reads the processes of this host from /proc. For a process that is gone or not readable, functions return an empty
// value, 0 or false.   Threads: any.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace skein::cli {

/// The ids of all processes that /proc lists, in no particular order.
std::vector<pid_t> all_processes();
/// Process id of the parent; 0: the process is gone.
pid_t parent_of(pid_t pid);
/// Process id of the process's debugger; 0: none.
pid_t tracer_of(pid_t pid);
/// Whether a signal such as SIGSTOP has stopped the process; false if its debugger stopped it.
bool has_stopped(pid_t pid);
/// Short name of a process, as `ps` shows it.
std::string process_name(pid_t pid);
/// Words of the command line, or entries NAME=VALUE. @param what  "cmdline" or "environ".
std::vector<std::string> words_of(pid_t pid, const std::string& what);
/// User ids of the process: real, effective, saved, file system; none for a zombie.
std::vector<uid_t> users_of(pid_t pid);
/// Whether `user` is one of these ids.
bool belongs_to(pid_t pid, uid_t user);
/// Whether the process is in the network namespace of this process, not in that of a container or of `ip netns`.
bool shares_network(pid_t pid);

}  // namespace skein::cli
