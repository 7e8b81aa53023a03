#include "sim_server/scenes/scene_source.hpp"

#include <map>
#include <string>

#include "core/drawn_worlds.hpp"
#include "core/scene_families.hpp"
#include "sim_server/scene_files/box_file.hpp"
#include "sim_server/scene_files/limits.hpp"
#include "sim_server/scene_files/mesh_file.hpp"
#include "sim_server/scene_files/point_file.hpp"
#include "sim_server/scenes/cranes.hpp"
#include "sim_server/scenes/hangar.hpp"
#include "sim_server/scenes/kept_points.hpp"
#include "sim_server/scenes/mesh_builder.hpp"
#include "sim_server/scenes/sail.hpp"
#include "sim_server/scenes/spire.hpp"
#include "sim_server/scenes/towers.hpp"

namespace skein::sim {
namespace {

/// One line a family, as in core/scene_families.cpp.
const std::map<std::string, UnsampledScene (*)(std::uint64_t scene_seed)> kBuilders = {
    {"towers", &make_towers}, {"hangar", &make_hangar}, {"cranes", &make_cranes},
    {"sail", &make_sail},     {"spire", &make_spire},
};

UnsampledScene make_family(const Scenario& scenario) {
  const auto builder = kBuilders.find(scenario.scene.family);
  if (builder != kBuilders.end()) return builder->second(scenario.scene.scene_seed);
  std::string known;
  for (const auto& family : scene_families()) known += (known.empty() ? "" : ", ") + std::string(family.name);
  throw InputError(scenario.file.string() + ": scene.family: no family '" + scenario.scene.family +
                   "'; there are: " + known);
}

}  // namespace

Scene load_scene(const Scenario& scenario, const std::optional<std::filesystem::path>& cache) {
  if (!from_files(scenario.scene)) {
    UnsampledScene unsampled = make_family(scenario);
    return cache ? sampled_or_kept(std::move(unsampled), *cache) : sampled(std::move(unsampled));
  }
  Scene scene;
  for (const auto& file : scenario.scene.meshes) {
    append(scene.mesh, read_mesh(file));
    if (scene.mesh.triangles.size() <= kMostTriangles) continue;
    throw InputError(scenario.file.string() + ": scene.meshes: together they have more than the " +
                     std::to_string(kMostTriangles) + " triangles that are accepted; simplify them");
  }
  scene.points = read_points(scenario.scene.points);
  scene.boxes = read_boxes(scenario.scene.boxes);
  return scene;
}

}  // namespace skein::sim
