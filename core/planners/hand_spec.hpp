// The planner `hand` as --planner names it: whether somebody must fly, or a file does. Launcher and agent go by the
// same words.   Pure but for files of parameters; any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace skein {

/// The parameters of that planner as "key=value": of "hand", "hand:safe=false", "hand:params.yaml" or "hand:FILE.csv",
/// which is "file=FILE.csv". nullopt: it is another planner.
/// @throws InputError when a YAML file cannot be read.
std::optional<std::vector<std::string>> hand_parameters(const std::string& spec);

/// Whether somebody must fly: there is no file of commands. @throws InputError as above.
bool wants_hands(const std::string& spec);

}  // namespace skein
