// Range checks for numbers on the command line, for all programs; cli/option_checks.hpp has further ones for the
// launcher. They serve as validators for CLI11. CLI11's own (CLI::PositiveNumber, CLI::NonNegativeNumber, CLI::Range)
// accept "nan" and "0x10"; and the messages of CLI::PositiveNumber and CLI::NonNegativeNumber name the largest double,
// with 309 digits, as upper limit.   Pure.
#pragma once

#include <functional>
#include <string>

namespace skein {

/// @returns an empty text if `text` is a number above 0, otherwise an error message.
std::string check_positive(const std::string& text);
/// @returns an empty text if `text` is a number of at least 0, otherwise an error message.
std::string check_not_negative(const std::string& text);

/// Longest timeout that can be set, for the launcher and for programs [s of wall time]. With much longer ones, clocks
/// that count nanoseconds would overflow.
inline constexpr double kLongestTimeoutS = 36000.0;
/// @returns an empty text if `text` is a number of seconds within [0, kLongestTimeoutS], where 0 means no limit;
/// otherwise an error message.
std::string check_timeout_or_none(const std::string& text);

/// @returns an error message if `text` begins like an octal or hexadecimal number, which CLI11 would read as such: 010
/// as 8. An empty text otherwise, also for a text that is not a number.
std::string check_decimal(const std::string& text);
/// @returns an empty text if `text` is an unsigned whole number that fits into 64 bits, otherwise an error message.
/// CLI11 takes -1, and numbers that are too large, for the largest number.
std::string check_seed(const std::string& text);

/// @returns a function that checks in the same way that a text is a number within [least, most].
std::function<std::string(const std::string&)> number_within(double least, double most);

}  // namespace skein
