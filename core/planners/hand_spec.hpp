// Specs of the planner `hand` in the syntax of --planner: whether a pilot or a file of commands flies the UAV.
// Launcher and agent share these functions.   Pure, but they read parameter files; safe from any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace skein {

/// The parameters in a spec, each as "key=value". @param spec  "hand", "hand:safe=false", "hand:params.yaml" or
/// "hand:FILE.csv", which means "hand:file=FILE.csv". @returns nullopt for another planner.
/// @throws InputError when a YAML file cannot be read.
std::optional<std::vector<std::string>> hand_parameters(const std::string& spec);

/// Whether a pilot must fly: the planner is `hand`, without a file of commands. @throws InputError as above.
bool wants_hands(const std::string& spec);

}  // namespace skein
