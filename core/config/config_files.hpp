// Finds configuration files. Reads the file system and the environment; safe from any thread.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace skein {

/// Folder of the shipped configuration: SKEIN_CONFIG_DIR, else share/skein/config under this executable's install
/// prefix, else config/ of the source tree in which it was built (<exe>/../config up to four levels above).
/// @throws InputError if there is no such folder.
std::filesystem::path default_config_dir();

/// Finds a configuration file by name or path.
/// @param what  kind of file, for error messages: "scenario".
/// @param name_or_path  a path if it contains a '/' or ends in .yaml; otherwise a name, for `folder`/<name>.yaml.
/// @param base  folder to which a relative path refers; empty: the working directory.
/// @param other_names  names without a file that the user may also mean.
/// @throws InputError if there is no such file; the message suggests names that exist, and `other_names`.
std::filesystem::path find_config_file(const std::string& what, const std::string& name_or_path,
                                       const std::filesystem::path& folder, const std::filesystem::path& base = {},
                                       const std::vector<std::string>& other_names = {});

/// Names (without .yaml) of the files in a folder, sorted; empty when there is no such folder.
std::vector<std::string> config_names(const std::filesystem::path& folder);

}  // namespace skein
