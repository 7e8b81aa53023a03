// Where configuration files are. Reads the file system and the environment; safe from any thread.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace skein {

/// Folder of the shipped configuration: SKEIN_CONFIG_DIR, else share/skein/config of the prefix that this executable is
/// installed in, else config/ of the source tree that it was built in (<exe>/../config up to four levels above).
/// @throws InputError when there is none.
std::filesystem::path default_config_dir();

/// The file that a user means.
/// @param what "scenario", for messages.
/// @param name_or_path a path when it holds a '/' or ends in .yaml (relative ones from `base`; from the working
///   directory when that is empty); else the name of `folder`/<name>.yaml.
/// @throws InputError when there is no such file; the message helps with the names that exist.
std::filesystem::path find_config_file(const std::string& what, const std::string& name_or_path,
                                       const std::filesystem::path& folder, const std::filesystem::path& base = {});

/// Names (without .yaml) of the files in a folder, sorted; empty when there is no such folder.
std::vector<std::string> config_names(const std::filesystem::path& folder);

}  // namespace skein
