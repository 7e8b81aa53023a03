// One flight of a benchmark, as `skein run` flies it, without a word of its own on the console.
#pragma once

#include <string>

#include "cli/run_command.hpp"
#include "results/result.hpp"

namespace skein::cli {

struct Flown {
  Json result;       ///< its result.json
  bool well = true;  ///< it went to its end with everybody on board
  std::string said;  ///< its messages
};

/// @param run  with the folder of its results.
/// @throws Interrupted after Ctrl-C, std::runtime_error if it left no result.
Flown fly(const RunOptions& run);

}  // namespace skein::cli
