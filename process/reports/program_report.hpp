// A program's last words: what it did, for the launcher's result.json. They go through the status pipe, so that a full
// disk does not take them along, and into a file for whoever has no launcher.
#pragma once

#include <filesystem>

#include "process/json_text.hpp"
#include "process/status/status_pipe.hpp"

namespace skein {

/// Sends it as a status::Report, after writing `file`. A file that cannot be written is added to the report's
/// list `unwritten`, where a program names all such files, one sentence each.
/// @throws std::runtime_error when the file cannot be written and there is no launcher either.
void hand_in_report(Json report, const std::filesystem::path& file, StatusPipe& status);

/// When a program begins to work: what lies there was said of another run, by one that used the same folder.
void withdraw_report(const std::filesystem::path& file);

}  // namespace skein
