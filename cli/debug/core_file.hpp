// --cores: what a crashed program's memory was, kept beside its log. Linux.   Threads: any.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace skein::cli {

/// From here on programs that we start may leave a core. @throws InputError when the system forbids it.
void allow_cores();

/// The file name of a core. @param pattern  of /proc/sys/kernel/core_pattern (core(5))
/// @param adds_pid  /proc/sys/kernel/core_uses_pid
/// @returns a pattern with '*' for what is not known here; nullopt: another program gets the cores
std::optional<std::string> core_name(std::string_view pattern, bool adds_pid, pid_t pid);

/// Moves the core that a process has just left to `file`. What lay there before allow_cores() is another's.
/// @returns where it is, for people: "core in uav_agent-jurong.core"; empty: there is none.
std::string keep_core(pid_t pid, const std::filesystem::path& file);

}  // namespace skein::cli
