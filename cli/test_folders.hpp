// `skein test FOLDER...`: selects the CTest entries that belong to folders of the source tree.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace skein::cli {

/// A regular expression for CTest's --label-regex that matches the tests in and below these folders. A test has its
/// folder as a label (skein_add_test()).
/// @param list  file that CMake writes: the folders that have tests, one per line.
/// @throws InputError  for a folder that is not in `list`, spelled as there; a '/' at its end is allowed.
std::string labels_of_folders(const std::vector<std::string>& folders, const std::filesystem::path& list);

}  // namespace skein::cli
