// `skein test FOLDER...`: which of CTest's entries stand in folders of the source tree.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace skein::cli {

/// The regular expression for the labels of the entries that stand in these folders, and below: CTest's
/// --label-regex. An entry has its folder as a label (skein_add_test()).
/// @param list  a file with the folders that have tests, a line each, as CMake writes it.
/// @throws InputError  for another folder, or one that is not named as in the source tree.
std::string labels_of_folders(const std::vector<std::string>& folders, const std::filesystem::path& list);

}  // namespace skein::cli
