// `skein convert`.
#pragma once

#include <filesystem>
#include <vector>

#include "cli/console.hpp"

namespace CLI {
class App;
}

namespace skein::cli {

/// `skein convert`: fault tests of earlier versions.
struct ConvertOptions {
  std::vector<std::filesystem::path> files;  ///< fault tests, or folders of them
  bool in_place = false;                     ///< rewrite the files, instead of printing their new text
};

/// Adds the command `convert`, whose options CLI11 parses into the second argument.
void add_convert(CLI::App& app, ConvertOptions& convert);

/// `skein convert`: turns fault tests of earlier versions into those of this one. Prints the converted text of each
/// file; with `--in-place` rewrites the files that change, and prints their names.
/// @throws InputError for the first file that cannot be read or converted.
int convert_files(const ConvertOptions& options, const Console& console);

}  // namespace skein::cli
