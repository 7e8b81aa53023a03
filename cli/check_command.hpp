// `skein check`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/console.hpp"

namespace CLI {
class App;
}

namespace skein::cli {

struct CheckOptions {
  std::vector<std::string> files;
  std::vector<std::string> golden;  ///< CSV files of reference vectors
  std::optional<std::filesystem::path> assets;
  std::optional<std::filesystem::path> agent = {};  ///< as in RunOptions
  std::string scenario = "towers";                  ///< for fault files that name no scenario themselves
  std::optional<std::string> conditions = {};       ///< conditions for such files, instead of the scenario's
};

/// Adds the command `check`, whose options CLI11 parses into the second argument.
void add_check(CLI::App& app, CheckOptions& check);

/// @param arguments  the whole command line. @throws InputError if the options name no file.
void finish_check(CheckOptions& check, const std::vector<std::string>& arguments);

/// `skein check`: checks scenario, vehicle and fault files, fault tests, and tables of reference vectors. Prints one
/// line for each valid file, and on console.err what is wrong with each other one.
/// @returns the worst exit code of all files: kExitBadInput for an invalid one, that of `sim_server --golden` for
///   reference vectors. @throws Interrupted
int check_files(const CheckOptions& options, const Console& console);

}  // namespace skein::cli
