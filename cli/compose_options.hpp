// The options of `skein compose`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "run/run_options.hpp"

namespace CLI {
class App;
}

namespace skein::cli {

/// `skein compose`: a fleet in containers.
struct ComposeOptions {
  RunOptions run;
  std::optional<std::filesystem::path> file;   ///< file to write; none: standard output
  std::vector<std::string> images;             ///< UAV=IMAGE: replaces the image of that UAV's agent
  std::optional<std::string> subnet;           ///< network to divide: "172.30.0.0/20"
  std::optional<std::filesystem::path> build;  ///< folder of a build; its programs fly, not the images'
  bool up = false;                             ///< fly the fleet now
  bool stack = false;                          ///< a file for `docker stack`: several engines that form one swarm
};

/// Adds the command `compose`, whose options CLI11 parses into the second argument.
void add_compose(CLI::App& app, ComposeOptions& compose);
/// Checks and completes the parsed options. @param arguments  the whole command line
/// @throws InputError for options that do not go together.
void finish_compose(ComposeOptions& compose, const std::vector<std::string>& arguments);

}  // namespace skein::cli
