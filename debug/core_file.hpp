// --cores: keeps the core dump of a crashed program beside its log. Linux.   Threads: any, after allow_cores().
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace skein::cli {

/// Lets programs that this process starts from now on leave a core. @throws InputError when the system forbids it.
void allow_cores();

/// The file name of a process's core. @param pattern  content of /proc/sys/kernel/core_pattern (core(5))
/// @param adds_pid  whether /proc/sys/kernel/core_uses_pid is 1
/// @returns the name with '*' for unknown parts; nullopt: the kernel pipes cores to another program
std::optional<std::string> core_name(std::string_view pattern, bool adds_pid, pid_t pid);

/// Moves the core that a process has just left to `file`. Ignores cores from before allow_cores().
/// @returns where the core is, as text: "core in uav_agent-jurong.core"; empty: there is none.
std::string keep_core(pid_t pid, const std::filesystem::path& file);

}  // namespace skein::cli
