#include "core/text/text.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <utility>

#include "core/text/utf8.hpp"
#include "core/types.hpp"

namespace skein {

std::string shortest(double value) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  return {digits.data(), end.ptr};
}

std::string number_text(double value) { return shortest(std::round(value * 1e6) / 1e6); }

std::string fixed(double value, int digits) {
  std::string text = fmt::format("{:.{}f}", value, digits);
  const bool is_zero = text.find_first_not_of("-0.") == std::string::npos;
  if (is_zero && text.starts_with('-')) text.erase(0, 1);
  return text;
}

std::string fixed_at_most(double value, int digits) {
  std::string text = fixed(value, digits);
  if (text.find('.') == std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

std::string significant(double value, int digits) { return fmt::format("{:.{}g}", value, digits); }

std::optional<double> parse_number(std::string_view text) {
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, value);
  if (read.ec != std::errc() || read.ptr != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t end; (end = text.find(separator)) != std::string_view::npos; text.remove_prefix(end + 1)) {
    parts.emplace_back(text.substr(0, end));
  }
  parts.emplace_back(text);
  return parts;
}

std::string shell_word(const std::string& word) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) != 0 || std::strchr("_-./:=,+", c) != nullptr; };
  if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

std::string shell_line(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + shell_word(word);
  return line;
}

std::vector<std::string> shell_words(const std::string& command) {
  std::vector<std::string> words;
  bool in_word = false;
  char quote = 0;
  const auto refuse = [&](bool wrong, const std::string& why) {
    if (wrong) throw InputError("'" + command + "' is not a command with its arguments: " + why);
  };
  const auto add = [&](char letter) {
    if (!in_word) words.emplace_back();
    in_word = true;
    if (letter != 0) words.back() += letter;
  };
  for (std::size_t i = 0; i < command.size(); ++i) {
    const char letter = command[i];
    const bool escapes = letter == '\\' && quote != '\'' && i + 1 < command.size() &&
                         (quote == 0 || std::string("\"\\$`").find(command[i + 1]) != std::string::npos);
    if (escapes) {
      add(command[++i]);
    } else if (letter == quote) {
      quote = 0;
    } else if (quote == 0 && (letter == '\'' || letter == '"')) {
      quote = letter;
      add(0);  // it may stay empty
    } else if (quote == 0 && (letter == ' ' || letter == '\t')) {
      in_word = false;
    } else {
      const bool of_shell =
          quote != '\'' && std::string(quote == 0 ? ";|&<>()$`\n" : "$`").find(letter) != std::string::npos;
      refuse(of_shell, std::string("for ") + letter + " give it to a shell, /bin/sh -c '...'");
      add(letter);
    }
  }
  refuse(quote != 0, "a quote is not closed");
  return words;
}

std::string shortened(const std::string& text) {
  constexpr std::size_t kLongest = 80;
  if (text.size() <= kLongest) return text;
  return first_bytes(text, kLongest) + "...";
}

std::string printable(std::string text) {
  const auto is_forbidden = [](unsigned char c) { return c < 0x20 && c != '\n' && c != '\t'; };
  std::replace_if(text.begin(), text.end(), is_forbidden, '?');
  return as_utf8(std::move(text));
}

}  // namespace skein
