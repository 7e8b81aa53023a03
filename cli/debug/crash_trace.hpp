// A crashed program's last notes, with names: what process/health/crash_notes.hpp wrote as addresses.   Threads: any.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "cli/host/program_host.hpp"

namespace skein::cli {

/// Appends function names, files and lines to a log that ends with the notes of a crash, as far as addr2line and the
/// debug information know them. @returns whether there were such notes.
bool explain_crash(const std::filesystem::path& log);

/// What a crashed program left for whoever wants to know: explain_crash()'s backtrace, and its core beside the log.
/// @returns "backtrace in uav_agent-jurong.log, core in uav_agent-jurong.core"; empty: nothing
std::string crash_evidence(const ExitStatus& exit, const std::filesystem::path& log, bool with_core);

/// The end of a log as a message quotes it: its last lines, each below the one before; where a crash ends it,
/// the lines before that, and where the crash was.
std::string end_of_log(const std::filesystem::path& log, std::size_t lines);

}  // namespace skein::cli
