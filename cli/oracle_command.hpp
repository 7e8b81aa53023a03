// `skein oracle`: what could be had of a scenario with full knowledge (docs/oracle.md), and the same for `skein run`.
#pragma once

#include "cli/console.hpp"
#include "cli/options.hpp"
#include "results/result.hpp"

namespace skein::cli {

/// Prints a table, or JSON. @throws InputError for a scenario that is wrong, Interrupted.
int consult_oracle(const OracleOptions& options, const Console& console);

/// What is attainable in a run's scenario: from the oracle's cache, or computed where that takes seconds. Never throws.
struct AttainableAnswer {
  Json attainable;   ///< as result.json has it; null where nobody could tell
  Json by_point;     ///< the oracle's whole answer, with `estimate` and `flyable` of each point; null likewise
  std::string hint;  ///< why not, and what to do about it; empty where there is nothing to say
};
AttainableAnswer attainable_of(const RunOptions& run);

/// The oracle's answer as result.json has it: `reachable` with its clearance, and `outside`. Null for anything else.
Json attainable_from(const Json& answer);

/// The table of `skein oracle`: one answer at length, of several a row each.
/// @param answers  not empty.   @param outside_only  leaves the other figures out.
void print_oracle(std::ostream& out, const std::string& scenario, const Json& answers, bool outside_only);

}  // namespace skein::cli
