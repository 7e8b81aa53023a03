// Range checks for numbers on the command line, for programs that do not use the launcher's checks
// (cli/option_checks.hpp). Each function is a CLI11 validator. CLI11's own validators would print the largest double,
// with 309 digits, as the upper limit.   Pure.
#pragma once

#include <functional>
#include <string>

namespace skein {

/// @returns an error message unless the text is a number above 0, otherwise an empty text.
std::string check_positive(const std::string& text);
/// @returns an error message unless the text is a number of at least 0, otherwise an empty text.
std::string check_not_negative(const std::string& text);

/// A validator of numbers within [least, most]. Unlike CLI::Range it refuses "nan" and "0x10", too.
std::function<std::string(const std::string&)> number_within(double least, double most);

}  // namespace skein
