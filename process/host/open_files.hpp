// The limit of a process's open files (`ulimit -n`), sockets and pipes among them.   Threads: any.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <system_error>

namespace skein {

/// The limit of this process; nullopt: there is none.
std::optional<std::uint64_t> open_files_limit();
/// Raises the limit of this process, which its children inherit, to `files`, or as far as the system permits (the hard
/// limit). Never lowers it.
void raise_open_files_limit(std::uint64_t files);

/// A hint to append to the system's message if this limit caused a failure, because "Too many open files" does not name
/// the limit: "; a process may have 20 open files (ulimit -n)...". Empty if `code` names another cause.
std::string open_files_hint(const std::error_code& code);

/// An estimate, rounded up, of the open files that a fleet's server needs over DDS. No program needs more, because the
/// server joins all domains. From measurements with both vendors and 5 UAVs.
constexpr std::uint64_t ample_open_files(std::uint64_t domains) { return 20 + 9 * domains; }

}  // namespace skein
