// What a number on a command line must be, for programs without the launcher's own checks (cli/option_checks.hpp).
// Each is a validator for CLI11, whose own names the largest double, 309 digits, as the limit.   Pure.
#pragma once

#include <string>

namespace skein {

/// @returns what is wrong with a text that must be a number above 0, or nothing.
std::string check_positive(const std::string& text);
/// @returns what is wrong with a text that must be a number of at least 0, or nothing.
std::string check_not_negative(const std::string& text);

}  // namespace skein
