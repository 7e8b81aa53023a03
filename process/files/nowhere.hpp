// The folder /dev/null, in which nothing is kept: a program that is told to write there (--out /dev/null) leaves no
// files. Of a fleet that is stepped nobody reads any, and many of them fly at once.   Pure; any thread.
#pragma once

#include <filesystem>

namespace skein {

inline constexpr const char* kNowhere = "/dev/null";

/// Whether a file would be in that folder.
inline bool is_nowhere(const std::filesystem::path& file) { return file.parent_path() == kNowhere; }

}  // namespace skein
