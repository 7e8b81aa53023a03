// The first lines of a docker-compose file that `skein compose` makes, by which the next call recognises it.
// Threads: any.
#pragma once

#include <filesystem>
#include <string>

namespace skein::cli {

/// The comment that a file begins with. @param scenario  its name. @param command  the command that made the file
std::string compose_header(const std::string& scenario, const std::string& command);

/// Whether a file begins with such a comment. False if it cannot be read, or is not a regular file.
bool is_compose_file(const std::filesystem::path& file);

}  // namespace skein::cli
