// `skein oracle`: the score attainable in a scenario with full knowledge (docs/oracle.md), also for `skein run`.
#pragma once

#include "cli/console.hpp"
#include "cli/options.hpp"
#include "results/result.hpp"

namespace skein::cli {

/// Prints a table, or JSON. @returns the exit code. @throws InputError for an invalid scenario; std::runtime_error when
///   sim_server fails; Interrupted.
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
