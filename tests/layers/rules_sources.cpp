// The rule that numbers in uav_agent/ say where they come from.
#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include "tests/layers/rules.hpp"

namespace skein::layers {
namespace {

constexpr const char* kFlightConfig = "uav_agent/flight_core/flight_config.hpp";

bool is_part_of_number(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '\'';
}

/// A number in a line of code.
struct Literal {
  std::string text;
  double value = 0.0;
  bool is_float = false, is_hexadecimal = false;
  char before = ' ', after = ' ';  ///< the nearest characters beside it that are no spaces
};

Literal literal_at(const std::string& line, std::size_t begin, std::size_t end) {
  Literal literal{.text = line.substr(begin, end - begin)};
  std::string digits = literal.text;
  std::erase(digits, '\'');
  literal.value = std::strtod(digits.c_str(), nullptr);
  literal.is_hexadecimal = digits.starts_with("0x") || digits.starts_with("0X");
  literal.is_float = !literal.is_hexadecimal && digits.find_first_of(".eE") != std::string::npos;
  const std::size_t before = begin == 0 ? std::string::npos : line.find_last_not_of(' ', begin - 1);
  const std::size_t after = line.find_first_not_of(' ', end);
  if (before != std::string::npos) literal.before = line[before];
  if (after != std::string::npos) literal.after = line[after];
  return literal;
}

std::vector<Literal> literals_in(const std::string& line) {
  const auto is_digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  std::vector<Literal> literals;
  for (std::size_t begin = 0; begin < line.size();) {
    const auto goes_on = [&](std::size_t i) {
      const bool signs_exponent = i > begin && is_digit(line[begin]) && (line[i] == '-' || line[i] == '+') &&
                                  (line[i - 1] == 'e' || line[i - 1] == 'E');
      return is_part_of_number(line[i]) || signs_exponent;
    };
    std::size_t end = begin;
    while (end < line.size() && goes_on(end)) ++end;
    if (end > begin && is_digit(line[begin])) literals.push_back(literal_at(line, begin, end));
    begin = std::max(end, begin + 1);
  }
  return literals;
}

/// What the numbers in a line of code are for.
enum class Use { constant, member, expression };
Use use_in(const SourceFile& file, const std::string& line) {
  static const std::regex kConstant(R"(\bk[A-Z]\w*(\[\w*\])?( = |\{))");
  static const std::regex kMember(
      R"( +(double|float|int|unsigned|std::size_t|std::u?int\d+_t|Tick|std::vector<double>) [a-z]\w* = .*)");
  if (line.find("constexpr") != std::string::npos && std::regex_search(line, kConstant)) return Use::constant;
  return file.is_header() && std::regex_match(line, kMember) ? Use::member : Use::expression;
}

/// Whether a number needs no source: none, one, half or double of something, the axes of space, and bits, indices and
/// sizes of types.
bool is_plain(const Literal& literal, Use use, bool shifts) {
  if (literal.value == 0.0 || (!literal.is_float && literal.value == 1.0)) return true;
  if (use == Use::constant) return false;
  if (literal.is_float)
    return use == Use::expression && (literal.value == 0.5 || literal.value == 1.0 || literal.value == 2.0);
  if (use == Use::member) return false;
  const auto one_of = [](char c, std::string_view chars) { return chars.find(c) != std::string_view::npos; };
  const bool in_type = literal.after == '>' && one_of(literal.before, "<,");
  return literal.value == 2.0 || literal.value == 3.0 || literal.is_hexadecimal || shifts || in_type ||
         one_of(literal.before, "&|%^[") || one_of(literal.after, "&|%^]");
}

/// Whether the comment of a line, or the one above the statement that the line belongs to, names a source.
bool has_source(const SourceFile& file, std::size_t line) {
  static const std::regex kSource(
      R"(\b(chosen|measured|formula|geometry|vehicle|sensor|rounding|numeric|format|memory)\b)", std::regex::icase);
  const auto is_blank = [](const std::string& text) { return text.find_first_not_of(' ') == std::string::npos; };
  const auto names = [&](std::size_t i) { return std::regex_search(file.comments[i], kSource); };
  if (names(line)) return true;
  const auto goes_on = [&](std::string code) {  // whether the statement continues in the next line
    code.erase(code.find_last_not_of(' ') + 1);
    return !code.empty() &&
           (code.ends_with("= {") || std::string_view(";{}:").find(code.back()) == std::string_view::npos);
  };
  for (; line > 0 && goes_on(file.code[line - 1]); --line) {
    if (names(line - 1)) return true;
  }
  for (; line > 0 && is_blank(file.code[line - 1]) && !is_blank(file.comments[line - 1]); --line) {
    if (names(line - 1)) return true;
  }
  return false;
}

/// The numbers of a file that lack a source, as "path:line: 0.3".
std::vector<std::string> without_source(const SourceFile& file) {
  std::vector<std::string> found;
  for (std::size_t i = 0; i < file.code.size(); ++i) {
    const std::string& line = file.code[i];
    if (line.starts_with("#")) continue;
    const std::vector<Literal> literals = literals_in(line);
    if (std::ranges::all_of(literals, [](const Literal& literal) { return literal.value == 0.0; })) continue;
    const Use use = use_in(file, line);
    if (file.path == kFlightConfig && use != Use::constant)
      continue;                                                // a parameter; docs/flight-core.md names its source
    if (line.find("r.field(") != std::string::npos) continue;  // the limits of a parameter need no source
    const bool shifts = line.find("<<") != std::string::npos || line.find(">>") != std::string::npos;
    std::vector<std::string> of_line;
    for (const Literal& literal : literals) {
      if (!is_plain(literal, use, shifts))
        of_line.push_back(file.path + ":" + std::to_string(i + 1) + ": " + literal.text);
    }
    if (!of_line.empty() && !has_source(file, i)) found.insert(found.end(), of_line.begin(), of_line.end());
  }
  return found;
}

}  // namespace

Violations check_sources(const Tree& tree) {
  Violations violations;
  for (const SourceFile& file : tree) {
    if (file.folder() != "uav_agent" || !file.is_cpp() || file.is_test()) continue;
    for (const std::string& place : without_source(file))
      violations.push_back(place + " has no source in its comment: chosen, measured, formula, ...");
  }
  return violations;
}

}  // namespace skein::layers
