// The command line of `skein`, read into plain structs. Nothing is opened or started here.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "cli/planner_spec.hpp"

namespace skein::cli {

struct RunOptions {
  std::string scenario = "towers";  ///< a name under config/scenarios/ or a YAML file
  std::string planner = kDefaultPlanner;
  std::uint64_t seed = 0;
  std::optional<std::uint64_t> scene_seed;
  std::optional<std::filesystem::path> assets;
  std::optional<double> duration_s;
  std::string dds = "cyclonedds";  ///< a vendor or "mixed"
  std::string clock = "lockstep";  ///< "lockstep", "realtime" or "realtime:FACTOR"
  std::optional<std::string> debug_uav;
  bool native = false;
  std::optional<int> domain;
  std::optional<double> stop_at_s;
  std::optional<std::filesystem::path> out;
  bool force = false;
};

struct TestOptions {
  bool long_tests = false;
};

struct CheckOptions {
  std::vector<std::string> files;
  std::vector<std::string> golden;  ///< CSV files of reference vectors
  std::optional<std::filesystem::path> assets;
};

struct DiffOptions {
  std::filesystem::path run_a, run_b;
};

/// --help or --version: what to print.
struct HelpText {
  std::string text;
};

using Command = std::variant<RunOptions, TestOptions, CheckOptions, DiffOptions, HelpText>;

/// @param arguments without the program's name. @throws InputError for anything that does not fit.
Command parse_command_line(const std::vector<std::string>& arguments);

}  // namespace skein::cli
