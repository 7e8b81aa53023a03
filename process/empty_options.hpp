// Refuses empty values, and empty items of lists, on the command line of the launcher and of all programs: they come
// from unset variables of scripts and are never meant.   Pure.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace skein {

/// Checks the options that were given to a program, or to a command and its subcommands.
/// @throws InputError that names the first option with an empty value.
void refuse_empty_values(const CLI::App& app);

/// The same for `--option=`, before the arguments are parsed: CLI11 would read `--keep-maps=` as `--keep-maps`, and
/// would take the next argument for the value of `--out=`.
/// @param app  whose options these are: a program, or the command that the arguments name
void refuse_empty_assignments(const CLI::App& app, const std::vector<std::string>& arguments);

/// Refuses empty items in the lists, separated by commas, of the options that were given: CLI11 leaves them out.
/// @param arguments  the whole command line, which has been parsed
/// @throws InputError that names the first such option.
void refuse_empty_items(const CLI::App& app, const std::vector<std::string>& arguments);

}  // namespace skein
