// Writes the results of a run that has ended: result.json, score.csv, work.csv, losses.csv and the summary.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/console.hpp"
#include "results/result.hpp"
#include "run/fleet_run.hpp"
#include "run/run_options.hpp"

namespace skein::cli {

/// What the results are made of. Holds references: all must outlive this.
struct RunResults {
  const RunOptions& options;
  const results::RunFacts& facts;
  const Scenario& scenario;
  const results::Reports& reports;
  std::filesystem::path dir;                                  ///< folder with the files of the run
  std::function<std::string(const std::string& text)> write;  ///< writes result.json; returns the error, or nothing
};

/// @param shown  the folder as the user named it. @param collect  called once result.json is written: fetches files
///   from other places, and returns warnings.
/// @returns result.json; nullopt when it could not be written: then it was printed.
std::optional<Json> write_results(const RunResults& run, const std::filesystem::path& shown,
                                  const std::function<std::vector<std::string>()>& collect, const Console& console);

/// Exit code of the launcher after a run.
int exit_code_of(FleetRun& run, const Json& result);

}  // namespace skein::cli
