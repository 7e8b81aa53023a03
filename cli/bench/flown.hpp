// Flies one flight of a benchmark as `skein run` does, but prints nothing on the console.
#pragma once

#include <string>

#include "cli/actions.hpp"
#include "results/result.hpp"

namespace skein::cli {

struct Flown {
  Json result;       ///< its result.json
  bool well = true;  ///< it flew to its end and lost no program
  std::string said;  ///< its messages
};

/// @param run  must name the results folder.
/// @throws Interrupted after Ctrl-C, std::runtime_error if it left no result.
Flown fly(const RunOptions& run);

}  // namespace skein::cli
