// What is made of a run when it is over: result.json, score.csv, work.csv, losses.csv and the summary.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/console.hpp"
#include "cli/options.hpp"
#include "cli/run/fleet_run.hpp"
#include "results/result.hpp"

namespace skein::cli {

/// What is known of it. All are referred to.
struct RunResults {
  const RunOptions& options;
  const results::RunFacts& facts;
  const Scenario& scenario;
  const results::Reports& reports;
  std::filesystem::path dir;                                  ///< where it left its files
  std::function<std::string(const std::string& text)> write;  ///< result.json; returns what went wrong, for people
};

/// @param shown  the folder as the user named it. @param collect  called once result.json is written: fetches what lies
///   elsewhere, and returns warnings.
/// @returns result.json; nullopt when the disk refused it: then it was printed.
std::optional<Json> write_results(const RunResults& run, const std::filesystem::path& shown,
                                  const std::function<std::vector<std::string>()>& collect, const Console& console);

/// Of the launcher after a run.
int exit_code_of(FleetRun& run, const Json& result);

}  // namespace skein::cli
