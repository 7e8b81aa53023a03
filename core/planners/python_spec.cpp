#include "core/planners/python_spec.hpp"

#include <algorithm>
#include <cctype>

#include "core/types.hpp"

namespace skein {
namespace {

constexpr std::string_view kPrefix = "py:";

/// Whether a text may be the name of a class, rather than parameters or a file. Python later checks the name itself.
bool is_class_name(const std::string& text) {
  const auto may_be_in_it = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c >= 0x80; };
  return !text.empty() && std::isdigit(static_cast<unsigned char>(text[0])) == 0 &&
         std::ranges::all_of(text, may_be_in_it);
}

/// Where the file's name ends: folders may have colons, and a planner's file ends with ".py".
std::size_t end_of_file(const std::string& rest) {
  constexpr std::string_view kEnding = ".py";
  for (std::size_t at = rest.find(kEnding); at != std::string::npos; at = rest.find(kEnding, at + 1)) {
    const std::size_t end = at + kEnding.size();
    if (end == rest.size()) return std::string::npos;
    if (rest[end] == ':') return end;
  }
  return rest.find(':');
}

}  // namespace

std::optional<PythonSpec> python_spec(const std::string& spec) {
  if (!spec.starts_with(kPrefix)) return std::nullopt;
  std::string rest = spec.substr(kPrefix.size());
  const auto take_part = [&rest](std::size_t colon) {
    const std::string part = rest.substr(0, colon);
    rest = colon == std::string::npos ? "" : rest.substr(colon + 1);
    return part;
  };
  PythonSpec python{take_part(end_of_file(rest))};
  if (python.file.empty()) {
    throw InputError("--planner " + spec + ": a file must follow 'py:', such as py:my_planner.py");
  }
  if (is_class_name(rest.substr(0, rest.find(':')))) python.class_name = take_part(rest.find(':'));
  python.parameters = rest;
  return python;
}

std::string text_of(const PythonSpec& spec) {
  std::string text = std::string(kPrefix) + spec.file.string();
  if (!spec.class_name.empty()) text += ":" + spec.class_name;
  if (!spec.parameters.empty()) text += ":" + spec.parameters;
  return text;
}

std::string without_folders(const std::string& spec) try {
  auto python = python_spec(spec);
  if (!python) return spec;
  python->file = python->file.filename();
  return text_of(*python);
} catch (const InputError&) {
  return spec;
}

}  // namespace skein
