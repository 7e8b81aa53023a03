// The options of `skein hunt`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/sweep_options.hpp"
#include "run/run_options.hpp"

namespace CLI {
class App;
}

namespace skein::cli {

/// The usual number of cases in a round, and the most that --round takes.
inline constexpr std::size_t kUsualRound = 16, kMostRound = 10'000;

/// `skein hunt`: a search for faults that break a property.
struct HuntOptions {
  RunOptions run;                                   ///< the flight that the hunt varies
  std::optional<std::string> dds;                   ///< a vendor or "mixed"; none: in one process where possible
  std::optional<std::filesystem::path> properties;  ///< a property file, instead of the ready ones
  std::vector<std::string> without;                 ///< properties that are not evaluated
  std::vector<std::string> faults;                  ///< kinds of faults to draw from; empty: all
  std::vector<std::string> conditions;              ///< fly each case under one of these; empty: the scenario's own
  std::optional<std::size_t> runs;
  std::optional<double> minutes;
  std::optional<int> jobs;
  std::uint64_t seed = 1;   ///< seed of the search
  bool first = false;       ///< end the search with the first find
  std::size_t shrink = 40;  ///< maximum number of flights spent on minimising a find
  std::optional<std::filesystem::path> out, junit;
  bool force = false;               ///< start over in the folder of another hunt
  std::size_t round = kUsualRound;  ///< number of cases that are drawn before the first of them is evaluated
  SweepOptions sweep;
};

/// Adds the command `hunt`, whose options CLI11 parses into the second argument.
void add_hunt(CLI::App& app, HuntOptions& hunt);
/// Checks and completes the parsed options. @param arguments  the whole command line
/// @throws InputError for options that do not go together.
void finish_hunt(HuntOptions& hunt, const std::vector<std::string>& arguments);

}  // namespace skein::cli
