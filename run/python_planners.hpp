// Planners in Python, as the launcher sees them: the user's files, which it finds before the flight and copies into the
// run's folder, so that the run can be repeated after they have changed.   Threads: any.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "process/json_text.hpp"
#include "run/planner_spec.hpp"

namespace skein::cli {

/// Makes the paths of all planners in Python absolute, so that agents under other users or in other folders find them.
/// @throws InputError for a file that is not there, and for Python at the ground station.
void find_python_files(Planners& planners);

/// The planner's file, then the modules and packages in its folder that it may import, in a fixed order. At most a
/// hundred files: of a folder with more, the planner's file only.
std::vector<std::filesystem::path> python_sources(const std::filesystem::path& file);

/// SHA-256 over the names and contents of python_sources(), in hexadecimal.
std::string python_digest(const std::filesystem::path& file);

/// Copies the sources of all planners in Python into the folder of a run.
/// @returns for result.json, an array with one entry per planner's file: the path `file`, its copy `kept` relative to
///   the run's folder, and the `sha256` of all its sources; empty if no planner is in Python, or copying fails.
/// @param warnings  gets a line when copying fails: the run is valid without the copies.
Json keep_python_files(const std::vector<UavPlanner>& planners, const std::filesystem::path& run,
                       std::vector<std::string>& warnings);

/// The value of --planner that repeats a run with its Python files as they were: the run's copy replaces each file that
/// has changed since. @param text, fleet  as for parse_planners(). @param tell  called with a message for each file
/// that it replaces
std::string with_python_files_of(const std::string& text, const std::vector<std::string>& fleet,
                                 const std::filesystem::path& run, const Json& result,
                                 const std::function<void(const std::string&)>& tell);

}  // namespace skein::cli
