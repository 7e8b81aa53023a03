// The rule for the length of functions.
#include <algorithm>
#include <cctype>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/layers/rules.hpp"

namespace skein::layers {
namespace {

struct Function {
  std::string name;
  std::size_t line = 0;   ///< of its opening brace, or of its head in Python and JavaScript; from 1
  std::size_t lines = 0;  ///< of its body
};

bool is_part_of_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// Whether the text before a brace declares something other than a function.
bool declares_no_function(const std::string& head) {
  static const std::set<std::string> kOthers = {"namespace", "class", "struct", "enum", "union", "extern"};
  const auto begin = std::ranges::find_if(head, is_part_of_name);
  return head.find('(') == std::string::npos ||
         kOthers.contains({begin, std::find_if_not(begin, head.end(), is_part_of_name)});
}

/// "plan" of "FleetPlan plan(const Options& options)".
std::string name_in(const std::string& head) {
  const auto end =
      std::find_if(head.rend() - static_cast<std::ptrdiff_t>(head.find('(')), head.rend(), is_part_of_name);
  return {std::find_if_not(end, head.rend(), is_part_of_name).base(), end.base()};
}

struct Brace {
  std::string function;  ///< the function whose body it opens; empty: none
  std::string head;      ///< the head that continues after the closing brace
  std::size_t line = 0;
};

/// Finds functions of C++ by their braces, in code that clang-format has formatted. Lambdas and classes inside a
/// function count as part of it.
std::vector<Function> functions_by_braces(const SourceFile& file) {
  std::vector<Function> functions;
  std::vector<Brace> open;
  std::string head;  // since the last statement or body, outside of functions
  const auto in_function = [&] { return !std::ranges::all_of(open, &std::string::empty, &Brace::function); };
  for (std::size_t i = 0; i < file.code.size(); ++i) {
    if (file.code[i].starts_with("#")) continue;
    for (const char c : file.code[i]) {
      if (c == '{') {
        const bool initializes = !head.empty() && is_part_of_name(head.back());  // "b_{x}"
        const bool begins = !initializes && !in_function() && !declares_no_function(head);
        open.push_back({begins ? name_in(head) : "", initializes ? head : "", i + 1});
        head.clear();
      } else if (c == '}' && !open.empty()) {
        const Brace& last = open.back();
        if (!last.function.empty()) functions.push_back({last.function, last.line, i - std::min(i, last.line)});
        head = last.head;
        open.pop_back();
      } else if (c == ';') {
        head.clear();
      } else {
        head += c;
      }
    }
    head += ' ';
  }
  return functions;
}

/// The name of the function of Python or JavaScript whose head begins in this line; empty: none does.
std::string name_in_line(const std::string& line, bool python) {
  static const std::regex kPython(R"( *(?:async )?def (\w+)\(.*)");
  static const std::vector<std::regex> kJavaScript = {
      std::regex(R"( *(?:export )?(?:async )?function\*? (\w+)\(.*)"),
      std::regex(R"( *(?:export )?const (\w+) = (?:async )?(?:\([^()]*\)|\w+) => \{)"),
      std::regex(R"( +(?:async |static |get |set )?(?!(?:if|for|while|switch|catch|function)\b)(\w+)\([^;]*\) \{)")};
  std::smatch match;
  if (python) return std::regex_match(line, match, kPython) ? match[1].str() : "";
  for (const std::regex& head : kJavaScript) {
    if (std::regex_match(line, match, head)) return match[1];
  }
  return "";
}

/// Finds functions of Python and JavaScript by their indentation. Functions inside a function count as part of it, and
/// also on their own.
std::vector<Function> functions_by_indentation(const SourceFile& file) {
  std::vector<Function> functions;
  for (std::size_t i = 0; i < file.lines.size(); ++i) {
    const std::string name = name_in_line(file.lines[i], file.is_python());
    if (name.empty()) continue;
    const std::size_t margin = file.lines[i].find_first_not_of(' ');
    std::size_t last = i;  // line of the body
    for (std::size_t k = i + 1; k < file.lines.size(); ++k) {
      const std::size_t begin = file.lines[k].find_first_not_of(' ');
      if (begin == std::string::npos) continue;
      const bool heads_end = begin == margin && file.lines[k][begin] == ')';
      if (begin <= margin && !heads_end) break;
      last = k;
    }
    functions.push_back({name, i + 1, last - i});
  }
  return functions;
}

std::vector<Function> functions_of(const SourceFile& file) {
  if (file.is_cpp()) return functions_by_braces(file);
  if (file.is_python() || file.is_javascript()) return functions_by_indentation(file);
  return {};
}

}  // namespace

const std::vector<LongFunction>& long_functions() {
  static const std::vector<LongFunction> kLong = {
      {"cli/run_command.cpp", "add_run", "a table: one statement for each option"},
      {"cli/hunt_options.cpp", "add_hunt", "the same"},
      {"core/expressions/signal_table.cpp", "make_table", "a table: one row for each signal"},
      {"report/style.cpp", "base_style", "one literal: a style sheet"},
      {"report/run_style.cpp", "run_style", "the same"},
      {"web/src/custody.js", "makeCustody", "an object: its functions share its state"},
      {"web/src/flight.js", "makeFlight", "the same"},
  };
  return kLong;
}

Violations check_functions(const Tree& tree, const std::vector<LongFunction>& known, std::size_t most_lines) {
  Violations violations;
  std::set<std::pair<std::string, std::string>> there;  // path and name of each function
  for (const SourceFile& file : tree) {
    if (file.is_test()) continue;
    for (const Function& function : functions_of(file)) {
      there.emplace(file.path, function.name);
      const bool is_known = std::ranges::any_of(
          known, [&](const LongFunction& one) { return one.path == file.path && one.name == function.name; });
      const bool is_long = function.lines > most_lines;
      if (is_long == is_known) continue;
      const std::string place = file.path + ":" + std::to_string(function.line) + ": " + function.name;
      violations.push_back(is_long ? place + " has " + std::to_string(function.lines) + " lines, more than " +
                                         std::to_string(most_lines) + "; has it two jobs?"
                                   : place + " is short and needs no reason in the list of long functions any more");
    }
  }
  for (const LongFunction& one : known) {
    if (there.contains({one.path, one.name})) continue;
    violations.push_back(one.path + ":1: has no function " + one.name + ", which the list of long functions names");
  }
  return violations;
}

}  // namespace skein::layers
