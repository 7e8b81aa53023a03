// Writes files so that a reader never sees a partly written file. Any thread.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace skein {

/// The users that may read a file that root writes: all, or all but agents (closed_to_agents.hpp).
enum class Readers { all, no_agents };

/// Whether a file is on the disk when the call returns. Without that, a program sees the same, but a machine that loses
/// its power may lose the file.
enum class Flush { to_disk, none };

/// Writes a temporary file in the same folder, flushes it to the disk and renames it to `path`: a reader sees either
/// the old content or the new, also after a crash unless `flush` is none. The folder must exist.
/// @throws std::runtime_error with the system's reason; no temporary file is left.
void write_file_atomically(const std::filesystem::path& path, std::string_view content, Readers readers = Readers::all,
                           Flush flush = Flush::to_disk);

/// Flushes a file that another program has written to the disk, then renames it to `path` in the same folder. The flush
/// comes first, because some disks report only then that they are full.
/// @throws std::system_error, with the name `path`; then the file keeps its former name.
void put_in_place(const std::filesystem::path& finished, const std::filesystem::path& path);

/// As write_file_atomically(), for a file that the user has named and that perhaps cannot be replaced: something is
/// mounted on it (a bind mount of a container), or its folder takes no new files. Then the function overwrites the
/// existing file, so readers may see a part of the text. On a full disk the former text stays.
void replace_or_overwrite(const std::filesystem::path& path, std::string_view content);

/// write_file_atomically(), for a file that the program can do without; a file in kNowhere (process/files/nowhere.hpp)
/// is not written.
/// @returns an error message for people, with the file's name; empty if there was no error.
std::string write_if_possible(const std::filesystem::path& path, std::string_view content);

}  // namespace skein
