// The limit of a process's open files (`ulimit -n`), sockets and pipes among them.   Threads: any.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <system_error>

namespace skein {

/// The limit of this process; nullopt: there is none.
std::optional<std::uint64_t> open_files_limit();

/// What a message about a failure should say besides if this limit was the cause, which the system's "Too many open
/// files" does not: "; a process may have 20 open files (ulimit -n)...". Empty if another cause is told.
std::string open_files_hint(const std::error_code& code);

/// Open files of the server of a fleet over DDS, which joins all domains; no program has more. An estimate, rounded up,
/// from measurements with both vendors and 5 UAVs.
constexpr std::uint64_t ample_open_files(std::uint64_t domains) { return 20 + 9 * domains; }

}  // namespace skein
