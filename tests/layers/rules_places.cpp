// The rules for what the tree has in one place or one form: names of a run's files, decisions, and names of tests.
#include <algorithm>
#include <array>
#include <ranges>
#include <regex>
#include <set>

#include "tests/layers/rules.hpp"

namespace skein::layers {

Violations check_run_files(const Tree& tree) {
  static const std::regex kFile(R"re("[\w.-]+\.[a-z]+")re");
  const auto files_in = [](const std::string& line) {
    return std::ranges::subrange(std::sregex_iterator(line.begin(), line.end(), kFile), std::sregex_iterator());
  };
  std::set<std::string> names;
  for (const SourceFile& file : tree) {
    if (file.path != "results/run_folder.hpp") continue;
    for (const std::string& line : file.lines) {
      if (!line.starts_with("inline constexpr")) continue;
      for (const std::smatch& name : files_in(line)) names.insert(name.str());
    }
  }
  Violations violations;
  for (const SourceFile& file : tree) {
    if (!file.is_cpp() || file.is_test() || file.path == "results/run_folder.hpp") continue;
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      for (const std::smatch& name : files_in(file.lines[i])) {
        const bool in_comment = file.comments[i].find(name.str()) != std::string::npos;
        if (in_comment || !names.contains(name.str())) continue;
        violations.push_back(file.path + ":" + std::to_string(i + 1) + ": results/run_folder.hpp has the name of " +
                             name.str());
      }
    }
  }
  return violations;
}

Violations check_decisions(const Tree& tree, std::size_t most_lines) {
  static constexpr std::array kSections = {"## Context", "## Decision", "## Consequences", "## Alternatives"};
  Violations violations;
  for (const SourceFile& file : tree) {
    if (!file.path.starts_with("docs/decisions/")) continue;
    if (file.lines.size() > most_lines) {
      violations.push_back(file.path + ":" + std::to_string(most_lines + 1) + ": a decision has at most " +
                           std::to_string(most_lines) + " lines");
    }
    const auto has = [&](const std::string& begin) {
      return std::ranges::any_of(file.lines, [&](const std::string& line) { return line.starts_with(begin); });
    };
    if (has("Superseded by [decision ")) continue;  // the decision is superseded as a whole, so its page is short
    for (const char* section : kSections) {
      if (!has(section)) violations.push_back(file.path + ":1: has no section '" + section + "'");
    }
  }
  return violations;
}

Violations check_test_names(const Tree& tree) {
  static const std::regex kCpp(
      R"(\bTEST(_F|_P)?\(\w+,\s*((Who(m|se|ever)?|What(ever)?|Nobody|Somebody)([A-Z0-9_]\w*)?)\s*\))");
  static const std::regex kPython(R"(\bdef\s+(test)_((who(m|se|ever)?|what(ever)?|nobody|somebody)(_\w*)?)\s*\()");
  Violations violations;
  for (const SourceFile& file : tree) {
    const bool python = file.path.ends_with(".py");
    if (!python && !file.is_cpp()) continue;
    const std::vector<std::string>& lines = python ? file.lines : file.code;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      // A line break may stand before the name.
      const std::string text = lines[i].ends_with(',') && i + 1 < lines.size() ? lines[i] + lines[i + 1] : lines[i];
      std::smatch name;
      if (!std::regex_search(text, name, python ? kPython : kCpp)) continue;
      violations.push_back(file.path + ":" + std::to_string(i + 1) + ": name the actor in the test's name " +
                           name[2].str());
    }
  }
  return violations;
}

}  // namespace skein::layers
