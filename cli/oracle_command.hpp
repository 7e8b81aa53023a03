// The oracle's answers (docs/oracle.md), for `skein oracle` and `skein run`.
#pragma once

#include <ostream>
#include <string>

#include "cli/command.hpp"
#include "results/result.hpp"

namespace skein::cli {

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
