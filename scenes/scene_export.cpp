#include "scenes/scene_export.hpp"

#include <algorithm>
#include <cctype>
#include <set>

#include "core/files/file_bytes.hpp"
#include "core/scenario/drawn_worlds.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "core/text/suggestion.hpp"
#include "process/files/atomic_file.hpp"
#include "process/files/closed_to_agents.hpp"
#include "results/run_folder.hpp"
#include "scenes/files/box_file.hpp"
#include "scenes/files/mesh_file.hpp"
#include "scenes/files/point_file.hpp"
#include "scenes/scene_picture.hpp"

namespace skein::sim {

namespace fs = std::filesystem;

namespace {

std::string file_name(std::string name) {
  std::replace_if(
      name.begin(), name.end(),
      [](char c) { return !std::isalnum(static_cast<unsigned char>(c)) && c != '_' && c != '-'; }, '_');
  return name;
}

/// File names for boxes, in their order: where several names would give the same one, the later ones end with a number.
std::vector<std::string> file_names(const std::vector<OrientedBox>& boxes) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const std::string plain = file_name(boxes[i].name);
    std::string name = plain;
    for (std::size_t number = i; !taken.insert(name).second; ++number) name = plain + "_" + std::to_string(number);
    names.push_back(name);
  }
  return names;
}

std::string origin(const SceneConfig& scene) {
  if (scene.family.empty()) return "files";
  return "the family " + scene.family + ", scene_seed " + std::to_string(scene.scene_seed);
}

/// The text of the scenario, changed to take its scene from the files beside it.
std::string scenario_text(Scenario scenario, const fs::path& mesh, const fs::path& points, const fs::path& boxes) {
  const std::string comment = "# Written by `skein scene`. Its scene is from " + origin(scenario.scene) + ".\n";
  if (!is_drawn_world(scenario.scene.family)) scenario.scene = {};
  scenario.scene.meshes = {"./" + mesh.string()};
  scenario.scene.points = "./" + points.string();
  scenario.scene.boxes = "./" + boxes.string();
  return comment + to_yaml(scenario);
}

/// Whether writing would destroy an existing file with other content.
bool is_in_the_way(const fs::path& path, const std::string& content) {
  std::error_code error;
  if (!fs::exists(path, error)) return false;
  if (!fs::is_regular_file(path, error) || fs::file_size(path, error) != content.size()) return true;
  return read_file_bytes(path, content.size()) != content;
}

}  // namespace

std::vector<ExportedFile> scene_export(const Scenario& scenario, const Scene& scene) {
  const std::string name = file_name(scenario.name);
  const fs::path model = fs::path(run_folder::kSceneFiles) / name, boxes = model / "bounding_boxes";
  std::vector<ExportedFile> files;
  files.push_back({model / (name + ".stl"), counted(scene.mesh.triangles.size(), "triangle"), to_stl(scene.mesh)});
  files.push_back(
      {model / (name + "_interest_points.pcd"), counted(scene.points.size(), "interest point"), to_pcd(scene.points)});
  files.push_back({boxes / "box_description.yaml",
                   std::to_string(scene.boxes.size()) + (scene.boxes.size() == 1 ? " box" : " boxes"),
                   to_box_description(scene.boxes)});
  const std::string scenario_yaml = scenario_text(scenario, files[0].path, files[1].path, files[2].path);
  const std::vector<std::string> box_files = file_names(scene.boxes);
  for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
    files.push_back({boxes / (box_files[i] + ".stl"), "surface of a box", to_stl(box_surface(scene.boxes[i]))});
  }
  files.push_back({name + ".yaml", "the scenario, " + counted(scenario.fleet.size(), "UAV"), scenario_yaml});
  return files;
}

ExportedFile scene_picture_file(const Scenario& scenario, const Scene& scene) {
  return {file_name(scenario.name) + ".svg", "a drawing", scene_picture(scenario, scene)};
}

void write_export(const std::vector<ExportedFile>& files, const fs::path& folder, bool overwrite) {
  for (const ExportedFile& file : files) {
    if (!overwrite && is_in_the_way(folder / file.path, file.content)) {
      throw InputError((folder / file.path).string() +
                       " exists already, and is another one; overwrite it with --force, or choose another --out");
    }
  }
  for (const ExportedFile& file : files) {
    const fs::path path = folder / file.path;
    const bool is_scenario = file.path.extension() == ".yaml" && !file.path.has_parent_path();
    try {
      fs::create_directories(path.parent_path());
      close_to_agents(folder / run_folder::kSceneFiles);
      write_file_atomically(path, file.content, is_scenario ? Readers::all : Readers::no_agents);
    } catch (const std::exception& reason) {
      throw InputError("--out " + folder.string() + ": cannot be written to: " + reason.what());
    }
  }
}

}  // namespace skein::sim
