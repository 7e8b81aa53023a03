#include "scenes/scene_source.hpp"

#include <map>
#include <string>

#include "core/scenario/drawn_worlds.hpp"
#include "core/scenario/scene_families.hpp"
#include "scenes/cranes.hpp"
#include "scenes/files/box_file.hpp"
#include "scenes/files/limits.hpp"
#include "scenes/files/mesh_file.hpp"
#include "scenes/files/point_file.hpp"
#include "scenes/hangar.hpp"
#include "scenes/kept_points.hpp"
#include "scenes/mesh_builder.hpp"
#include "scenes/sail.hpp"
#include "scenes/spire.hpp"
#include "scenes/towers.hpp"

namespace skein::sim {
namespace {

/// One entry per family in core/scenario/scene_families.cpp.
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
