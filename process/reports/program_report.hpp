// A program's final report, for the launcher's result.json. The program sends it through the status pipe, so that a
// full disk cannot destroy it, and writes it to a file, for runs without a launcher.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "process/json_text.hpp"
#include "process/status/status_pipe.hpp"

namespace skein {

/// Writes the report to `file`, with a checksum, then sends it as a status::Report. If the file cannot be written, adds
/// a sentence to the report's list `unwritten`, in which a program names all files that it could not write.
/// @throws std::runtime_error if the file cannot be written and the status pipe is not open (no launcher).
void hand_in_report(Json report, const std::filesystem::path& file, StatusPipe& status);

/// Adds those texts to a list of a report, such as `unwritten`, that the list does not contain yet, in their order.
void add_new(const std::vector<std::string>& more, std::vector<std::string>& texts);

/// Deletes the report of an earlier run from the same folder. Call it when the program starts to work.
void withdraw_report(const std::filesystem::path& file);

}  // namespace skein
