// What the values of the command line's options must be. Each check_*() is a validator for CLI11: it returns what is
// wrong with a text, or nothing.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace skein::cli {

/// "lockstep", "realtime" or "realtime:FACTOR" with a factor within [0.001, 1000].
std::string check_clock(const std::string& text);
/// A whole number that fits into 64 bits, without sign.
std::string check_seed(const std::string& text);
/// A decimal number of seconds, above 0 and at most ten hours, the longest mission: 1e18 would overflow the ticks.
std::string check_seconds(const std::string& text);
/// A decimal number of seconds within [1, 3600].
std::string check_maps_period(const std::string& text);

/// An empty text is never meant: it is a variable of a script that is not set.
/// @throws InputError that names the first option of a command that was given with one.
void refuse_empty_values(const CLI::App& app);

}  // namespace skein::cli
