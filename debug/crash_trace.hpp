// Adds names to the addresses that a crashed program left in its log (process/health/crash_notes.hpp). Threads: any.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "host/program_host.hpp"

namespace skein::cli {

/// Appends function names, files and lines to a log that ends with the notes of a crash, as far as addr2line and the
/// debug information know them. @returns whether there were such notes.
bool explain_crash(const std::filesystem::path& log);

/// Calls explain_crash(), and moves the core beside the log (`with_core`). Says where backtrace and core are:
/// @returns "backtrace in uav_agent-jurong.log, core in uav_agent-jurong.core"; empty: there is neither.
std::string crash_evidence(const ExitStatus& exit, const std::filesystem::path& log, bool with_core);

/// The end of a log, to be quoted in a message: its last `lines` lines, each on a line of its own. If the log ends with
/// the notes of a crash: the lines before these, then the innermost frames of the backtrace.
std::string end_of_log(const std::filesystem::path& log, std::size_t lines);

}  // namespace skein::cli
