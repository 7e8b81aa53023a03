// Planners in Python as the launcher sees them: files of the user's, which are found before anything flies, and kept
// with the run, so that it can be flown again when they have changed.   Threads: any.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cli/planner_spec.hpp"
#include "process/json_text.hpp"

namespace skein::cli {

/// Makes the files of all planners in Python absolute: agents of other users, and in other folders, find them.
/// @throws InputError for a file that is not there, and for Python at the ground station.
void find_python_files(Planners& planners);

/// The planner's file and what it may import from beside it, in a fixed order: modules and packages of its folder.
/// Not more than a hundred files; of a folder with more, the planner's file alone.
std::vector<std::filesystem::path> python_sources(const std::filesystem::path& file);

/// SHA-256 over names and contents.
std::string python_digest(const std::filesystem::path& file);

/// Copies them into the folder of a run. @returns for result.json: by planner's file `file`, its copy `kept` below the
/// run's folder and the `sha256` of all; empty: nobody flies Python.
/// @param warnings  hear of what could not be copied: a run is not worth less without.
Json keep_python_files(const std::vector<UavPlanner>& planners, const std::filesystem::path& run,
                       std::vector<std::string>& warnings);

/// --planner of a run that is flown again: its files as they were, those that the run kept where they have changed
/// since. @param text, fleet  as for parse_planners(). @param tell  what flies in the place of a file
std::string with_python_files_of(const std::string& text, const std::vector<std::string>& fleet,
                                 const std::filesystem::path& run, const Json& result,
                                 const std::function<void(const std::string&)>& tell);

}  // namespace skein::cli
