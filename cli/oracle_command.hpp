// The oracle's answers (docs/oracle.md), for `skein oracle` and `skein run`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "cli/console.hpp"
#include "results/result.hpp"
#include "run/run_options.hpp"

namespace CLI {
class App;
}

namespace skein::cli {

struct OracleOptions {
  std::string scenario;
  std::optional<std::uint64_t> scene_seed;
  std::optional<std::filesystem::path> assets;
  std::optional<std::string> rules;  ///< a preset, instead of the scenario's
  std::vector<double> clearances_m;  ///< instead of the oracle's default
  bool vehicle = false;              ///< measure clearance from a sphere about body and rotors, not from the camera
  bool outside_only = false;
  bool plan = false;  ///< also compute the score that a plan with full knowledge reaches in the mission time
  bool json = false;
};

/// Adds the command `oracle`, whose options CLI11 parses into the second argument.
void add_oracle(CLI::App& app, OracleOptions& oracle);

/// `skein oracle`: prints the score attainable in a scenario with full knowledge (docs/oracle.md), as a table or JSON.
/// @throws InputError for an invalid scenario; std::runtime_error when sim_server fails; Interrupted.
int consult_oracle(const OracleOptions& options, const Console& console);

/// What is attainable in a run's scenario.
struct AttainableAnswer {
  Json attainable;   ///< as result.json has it; null if unknown
  Json by_point;     ///< the oracle's whole answer, with `estimate` and `flyable` of each point; null if unknown
  std::string hint;  ///< why it is unknown, and what to do about it; empty if there is nothing to say
};
/// From the oracle's cache, or computed if that takes only seconds. Never throws.
AttainableAnswer attainable_of(const RunOptions& run);

/// The oracle's answer as result.json has it: `reachable` with its clearance, and `outside`. Null for anything else.
Json attainable_from(const Json& answer);

/// Prints the table of `skein oracle`: a single answer in detail, several answers as one row each.
/// @param answers  not empty.   @param outside_only  print only the figures for `outside`.
void print_oracle(std::ostream& out, const std::string& scenario, const Json& answers, bool outside_only);

}  // namespace skein::cli
