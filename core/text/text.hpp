// Small texts: numbers as people and files want them, the same in every locale; lists taken apart; words for a shell.
// Pure; safe from any thread.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace skein {

/// The shortest text that reads back to the same number.
std::string shortest(double value);
/// For a sentence: to six decimals, none too many.
std::string number_text(double value);
/// With this many digits behind the point; "-0" is "0".
std::string fixed(double value, int digits);
/// With at most this many digits behind the point: "3" and not "3.0".
std::string fixed_at_most(double value, int digits);
/// With this many digits that count, none of them a zero at the end.
std::string significant(double value, int digits);

/// The number that the whole text is: finite, in decimal notation, without a "+", blanks or 0x10.
std::optional<double> parse_number(std::string_view text);

/// What stands before, between and behind the separators: one part more than there are of these.
std::vector<std::string> split(std::string_view text, char separator = ',');

/// A word as a shell takes it, in quotes where it needs them.
std::string shell_word(const std::string& word);

/// A command line of words.
std::string shell_line(const std::vector<std::string>& words);

/// The words of a command line, quoted as a shell would have it, without what else a shell does.
/// @throws InputError when they are no words.
std::vector<std::string> shell_words(const std::string& line);

/// Control characters other than line breaks and tabs become '?': XML has no way to write them.
std::string printable(std::string text);

}  // namespace skein
