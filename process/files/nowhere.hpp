// The output folder /dev/null: a program with --out /dev/null writes no files. For fleets whose files nothing reads,
// such as many simultaneous fleets that a caller advances step by step.   Pure; any thread.
#pragma once

#include <filesystem>

namespace skein {

inline constexpr const char* kNowhere = "/dev/null";

/// Whether the path of a file is directly in that folder.
inline bool is_nowhere(const std::filesystem::path& file) { return file.parent_path() == kNowhere; }

}  // namespace skein
