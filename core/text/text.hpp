// Text helpers: formatting and parsing of numbers, the same in every locale; splitting of lists; quoting for a shell.
// Pure; safe from any thread.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace skein {

/// The shortest text that reads back to the same number.
std::string shortest(double value);
/// For messages: rounded to six decimals, without trailing zeros.
std::string number_text(double value);
/// With this many decimals; "0" instead of "-0".
std::string fixed(double value, int digits);
/// With at most this many decimals: "3" and not "3.0".
std::string fixed_at_most(double value, int digits);
/// With this many significant digits, as printf's %g: without trailing zeros after the point, and with an exponent if
/// the number is very large or small.
std::string significant(double value, int digits);

/// Parses the whole text as a finite decimal number. @returns nullopt if it is none, as with a "+", blanks, or "0x10".
std::optional<double> parse_number(std::string_view text);

/// Splits a text at each separator. n separators give n + 1 parts; parts may be empty.
std::vector<std::string> split(std::string_view text, char separator = ',');

/// Quotes a word for a shell, if necessary.
std::string shell_word(const std::string& word);

/// Joins words to a command line, quoted where necessary.
std::string shell_line(const std::vector<std::string>& words);

/// Splits a command line into words. Quotes and backslashes work as in a shell.
/// @throws InputError for an unclosed quote, or a character with another meaning in a shell (; | & < > ( ) $ `).
std::vector<std::string> shell_words(const std::string& line);

/// For messages that quote what a user wrote: texts of more than 80 bytes end early, in "...", and with a whole letter.
std::string shortened(const std::string& text);

/// Replaces control characters other than line feeds and tabs with '?', because XML cannot represent most of them.
std::string printable(std::string text);

}  // namespace skein
