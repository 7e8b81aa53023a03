// Validation of option values. Each check_*() is a validator for CLI11: it returns what is wrong with a text, or an
// empty string.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace skein::cli {

/// "lockstep", "realtime" or "realtime:FACTOR" with a factor within [0.001, 1000].
std::string check_clock(const std::string& text);
/// A decimal number of seconds, above 0 and at most ten hours, the longest mission: 1e18 would overflow the ticks.
std::string check_seconds(const std::string& text);
/// A decimal number of seconds of wall time within [0.1, 36000]: a program of the fleet cannot answer much sooner.
std::string check_timeout(const std::string& text);
/// A decimal number of seconds within [1, 3600].
std::string check_maps_period(const std::string& text);
/// A file that a command can write: a new one, or a regular file. A pipe without a reader would keep the command
/// waiting without end, and a device would be replaced by a file.
std::string check_file_to_write(const std::string& text);

/// Lets all options of a command, and of its subcommands, that take whole numbers refuse a leading zero and "0x10".
/// CLI11 would take them for octal and hexadecimal numbers: 010 for 8.
void refuse_leading_zeros(CLI::App& app);

/// Refuses arguments, and a current folder, that are not in UTF-8: programs in one process get their command lines as
/// JSON, and results and pages name these paths. Refuses a current folder that has been deleted. @throws InputError
void check_paths(const std::vector<std::string>& arguments);

}  // namespace skein::cli
