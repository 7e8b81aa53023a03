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

/// The number of open files that a process needs.
struct OpenFilesNeed {
  std::uint64_t least;  ///< with fewer, it cannot start
  std::uint64_t ample;  ///< with fewer, it may fail: an estimate, rounded up
};

/// The need of a program that joins so many domains over DDS. With fewer than `least`, the vendor ends the program when
/// it joins the last domains. As measured with 1 and 5 UAVs and everything recorded, the server has 15 files and 7 for
/// each domain over Cyclone DDS, 18 and 8 over Fast DDS; `least` adds two. The station with a page has no more, router
/// and agents have fewer. A secured program has fewer, since it does not use multicast.
constexpr OpenFilesNeed open_files_over_dds(std::uint64_t domains, bool fast_dds) {
  return {fast_dds ? 20 + 8 * domains : 17 + 7 * domains, ample_open_files(domains)};
}

/// @param who  needs the files, for messages: "a fleet of 5 UAVs". @param limit  open files that a process may have
/// @returns a warning when `limit` may be too low; empty: it is not.
/// @throws InputError that names the limit and the need when `who` cannot start.
std::string judge_open_files_limit(const std::string& who, const OpenFilesNeed& need, std::uint64_t limit);

/// Raises the limit of this process to what `who` needs, as far as the system permits, and judges it as above.
std::string provide_open_files(const std::string& who, const OpenFilesNeed& need);

}  // namespace skein
