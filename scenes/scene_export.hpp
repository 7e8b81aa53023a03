// Exports a scene as files in CARIC's layout, with a scenario that uses them. Reading the files gives the same scene,
// bit for bit: a run of the exported scenario has the same digest as a run of the original.
// Frame: W.   Units: m.   Threads: any.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/scenario/scenario.hpp"
#include "core/scenario/scene.hpp"

namespace skein::sim {

/// A file below the export's folder.
struct ExportedFile {
  std::filesystem::path path;  ///< relative
  std::string summary;         ///< what is in it, with counts
  std::string content;
};

/// All files of an export. <name> is the scenario's name, with '_' for characters that do not belong in a file name:
///   <name>.yaml                                     the scenario: all keys, with resolved starts and vehicles
///   models/<name>/<name>.stl                        all triangles, in order
///   models/<name>/<name>_interest_points.pcd        all points, in order
///   models/<name>/bounding_boxes/box_description.yaml, and <box>.stl for each box
/// Of boxes whose names give the same name of a file, the later ones have a number behind it. Pure.
std::vector<ExportedFile> scene_export(const Scenario& scenario, const Scene& scene);

/// A drawing of the scene (scene_picture.hpp): <name>.svg. Pure.
ExportedFile scene_picture_file(const Scenario& scenario, const Scene& scene);

/// Writes the files, each atomically. All but the scenario are closed to agents (process/files/closed_to_agents.hpp).
/// @param overwrite  replace files of an earlier export.
/// @throws InputError if `overwrite` is false and a file exists with other content (then nothing is written), or if the
///   folder cannot be written.
void write_export(const std::vector<ExportedFile>& files, const std::filesystem::path& folder, bool overwrite);

}  // namespace skein::sim
