// A crashed program's last notes, with names: what process/crash_notes.hpp wrote as addresses.   Threads: any.
#pragma once

#include <filesystem>

namespace skein::cli {

/// Appends function names, files and lines to a log that ends with the notes of a crash, as far as addr2line and the
/// debug information know them. @returns whether there were such notes.
bool explain_crash(const std::filesystem::path& log);

}  // namespace skein::cli
