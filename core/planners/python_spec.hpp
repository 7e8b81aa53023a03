// Specs of planners in Python in the syntax of --planner: py:FILE or py:FILE:CLASS, and parameters after another colon,
// as for any planner: py:FILE:CLASS:key=value,... Launcher and agent share these functions.
// Pure; safe from any thread.
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

/// @param spec  without "@AGENT" (uav_planner.hpp). @returns nullopt for another planner.
/// @throws InputError when no file follows "py:".
std::optional<PythonSpec> python_spec(const std::string& spec);

/// The inverse of python_spec().
std::string text_of(const PythonSpec& spec);

/// A short form for tables: the spec of a planner in Python without the folders of FILE; any other spec unchanged.
std::string without_folders(const std::string& spec);

}  // namespace skein
