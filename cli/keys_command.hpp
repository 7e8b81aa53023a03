// `skein keys`: makes the keys of a secured fleet. Writes files; one thread.
#pragma once

#include <filesystem>
#include <functional>

#include "cli/console.hpp"
#include "run/fleet_plan.hpp"

namespace CLI {
class App;
}

namespace skein::cli {

/// `skein keys`: certificates and permissions of a secured fleet.
struct KeysOptions {
  RunOptions run;             ///< the flight for which the keys are
  std::filesystem::path out;  ///< new folder, with a folder for each program
};

/// Adds the command `keys`, whose options CLI11 parses into the second argument.
void add_keys(CLI::App& app, KeysOptions& keys);

/// `skein keys`: makes the keys of a secured fleet that is started by hand or by other tools.
/// @throws InputError when the folder exists already or cannot be created; std::system_error when a key cannot be
///   written.
int make_keys(const KeysOptions& options, const Console& console);

/// Writes one folder of keys for each program. @param give  makes the user of the programs the owner of a path.
/// @throws std::system_error when a file cannot be written.
void write_keys(const FleetPlan& plan, int base_domain, const std::filesystem::path& folder,
                const std::function<void(const std::filesystem::path&)>& give);

}  // namespace skein::cli
