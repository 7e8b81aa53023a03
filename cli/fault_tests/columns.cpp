#include "cli/fault_tests/columns.hpp"

#include <algorithm>
#include <regex>
#include <sstream>
#include <vector>

namespace skein::cli {
namespace {

std::string line_of(const std::string& text, std::size_t number) {
  std::istringstream lines(text);
  std::string line;
  for (std::size_t i = 0; i < number; ++i) {
    if (!std::getline(lines, line)) return "";
  }
  return line;
}

/// The column of the last key of a path, counted from 1. Its enclosing keys, if they are on the same line, stand before
/// it.
std::size_t column_of(const std::string& key_path, const std::string& line) {
  static const std::regex kKey("[A-Za-z_][A-Za-z0-9_]*");
  std::size_t place = std::string::npos;
  for (std::sregex_iterator key(key_path.begin(), key_path.end(), kKey), end; key != end; ++key) {
    const std::regex there("(^|[^A-Za-z0-9_])" + key->str() + "['\"]?:");
    std::smatch found;
    const std::size_t from = place == std::string::npos ? 0 : place + 1;
    const std::string rest = line.substr(std::min(from, line.size()));
    if (std::regex_search(rest, found, there)) {
      place = from + static_cast<std::size_t>(found.position()) + static_cast<std::size_t>(found.length(1));
    }
  }
  if (place == std::string::npos) place = line.find_first_not_of(" -");
  return place == std::string::npos ? 1 : place + 1;
}

std::string with_column(const std::string& sentence, const ConfigDocument& document) {
  if (!sentence.starts_with(document.origin + ":")) return sentence;
  static const std::regex kPlace("^:([0-9]+): (?:(?:unknown|missing) key ')?([A-Za-z0-9_.\\[\\]]*)");
  const std::string behind = sentence.substr(document.origin.size());
  std::smatch found;
  constexpr std::size_t kMostDigits = 6;
  if (!std::regex_search(behind, found, kPlace) || found.length(1) > static_cast<std::ptrdiff_t>(kMostDigits)) {
    return sentence;
  }
  const std::string line = line_of(document.text, std::stoul(found[1]));
  return document.origin + ":" + found[1].str() + ":" + std::to_string(column_of(found[2], line)) +
         behind.substr(1 + static_cast<std::size_t>(found.length(1)));
}

}  // namespace

std::string with_columns(const std::string& said, const ConfigDocument& document) {
  std::istringstream sentences(said);
  std::string all;
  for (std::string sentence; std::getline(sentences, sentence);) {
    all += (all.empty() ? "" : "\n") + with_column(sentence, document);
  }
  return all;
}

}  // namespace skein::cli
