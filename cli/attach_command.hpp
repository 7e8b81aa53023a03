// `skein ps` and `skein attach`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cli/console.hpp"

namespace CLI {
class App;
}

namespace skein::cli {

/// `skein ps`: lists the fleets that are flying, with their processes.
struct PsOptions {};

/// `skein attach`: attaches a debugger to one program of a flying fleet.
struct AttachOptions {
  std::string what;                          ///< UAV[=TOOL], as for --debug
  std::optional<std::filesystem::path> run;  ///< results folder of its fleet; none: the only fleet that is flying
};

/// Adds the command `ps`, whose options CLI11 parses into the second argument.
void add_ps(CLI::App& app, PsOptions& none);

/// Adds the command `attach`, whose options CLI11 parses into the second argument.
void add_attach(CLI::App& app, AttachOptions& attach);

/// `skein ps`: prints a table of the user's running fleets. @returns kExitDone
int list_fleets(const PsOptions& options, const Console& console);

/// `skein attach`: replaces this process with the debugging tool, attached to one program of a flying fleet; returns
/// only on failure. @throws InputError when there is no such fleet or program, more than one, or no such tool.
int attach_to(const AttachOptions& options, const Console& console);

}  // namespace skein::cli
