// Flies one flight of a benchmark as `skein run` does, but prints nothing on the console.
#pragma once

#include <iosfwd>
#include <string>

#include "results/result.hpp"
#include "run/run_options.hpp"

namespace skein::cli {

/// @param run  must name the results folder
/// @param what  names the flight if it does not reach its end, or loses a program: then `failed` becomes true, and the
///   flight's messages are printed on `err`
/// @returns its result.json
/// @throws Interrupted after Ctrl-C, std::runtime_error if it left no result.
Json fly(const RunOptions& run, const std::string& what, std::ostream& err, bool& failed);

}  // namespace skein::cli
