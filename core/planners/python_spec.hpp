// A planner written in Python as --planner names it: py:FILE, py:FILE:CLASS, and parameters behind another colon, as
// those of any planner: py:FILE:CLASS:key=value,... Launcher and agent go by the same words.   Pure; any thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace skein {

struct PythonSpec {
  std::filesystem::path file;
  std::string class_name = {};  ///< empty: the only planner in the file
  std::string parameters = {};  ///< "key=value,..." or a YAML file; empty: none

  bool operator==(const PythonSpec&) const = default;
};

/// @param spec  without an AGENT. @returns nullopt: it is another planner.
/// @throws InputError when no file follows.
std::optional<PythonSpec> python_spec(const std::string& spec);

/// What python_spec() reads back.
std::string text_of(const PythonSpec& spec);

/// For a table: of a planner in Python without the folders of its file; any other one as it is.
std::string without_folders(const std::string& spec);

}  // namespace skein
