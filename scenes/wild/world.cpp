#include "scenes/wild/world.hpp"

#include <algorithm>
#include <stdexcept>

#include "core/math/euler.hpp"
#include "core/scenario/drawn_worlds.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "scenes/surface_sampling.hpp"
#include "scenes/wild/flyable.hpp"
#include "scenes/wild/site.hpp"

namespace skein::sim {
namespace {

constexpr int kMostAttempts = 200;
constexpr double kAreaPerPoint = 3.0;  ///< [m2]
constexpr std::size_t kFewestPoints = 100, kMostPoints = 2500;
const char* const kNames[] = {"jurong", "raffles", "sentosa", "changi", "nanyang", "punggol", "katong", "bedok"};

/// Area of the triangles whose centres lie in boxes [m2].
double area_in_boxes(const TriangleMesh& mesh, const std::vector<OrientedBox>& boxes) {
  double area = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vector3d a = mesh.vertices[t[0]].cast<double>(), b = mesh.vertices[t[1]].cast<double>(),
                   c = mesh.vertices[t[2]].cast<double>();
    const auto holds = [&](const OrientedBox& box) { return box.contains((a + b + c) / 3.0); };
    if (std::ranges::any_of(boxes, holds)) area += 0.5 * (b - a).cross(c - a).norm();
  }
  return area;
}

/// One attempt to draw a world; nullopt if it fails, for example because there is no room for the starts.
std::optional<World> attempt(const std::string& family, const wild::Dice& dice, bool blind,
                             const VehicleConfig& explorer, const VehicleConfig& photographer) {
  World world;
  const wild::Task task = wild::draw_task(dice, blind);
  std::vector<VehicleConfig> vehicles;
  for (const Role role : task.fleet) vehicles.push_back(role == Role::explorer ? explorer : photographer);
  const std::vector<wild::Standing> structures = wild::draw_structures(dice, task.area_m2);
  for (const wild::Standing& structure : structures) append(world.scene.mesh, structure.mesh);
  const wild::Starts starts = wild::draw_starts(dice, vehicles, structures, world.scene.mesh, blind);
  if (starts.p_W.size() != vehicles.size()) return std::nullopt;
  world.scene.boxes = wild::draw_boxes(dice, structures, starts.p_W);
  if (blind && !starts.beside.triangles.empty()) return std::nullopt;
  const double area = area_in_boxes(world.scene.mesh, world.scene.boxes);
  const auto count = std::clamp(static_cast<std::size_t>(area / kAreaPerPoint), kFewestPoints, kMostPoints);
  append(world.scene.mesh, starts.beside);
  if (!blind) append(world.scene.mesh, wild::draw_clutter(dice, structures, world.scene.boxes, starts));
  world.scene.points = sample_surface(world.scene.mesh, world.scene.boxes, count, dice.seed);
  if (world.scene.points.size() < kFewestPoints / 2) return std::nullopt;

  Scenario& scenario = world.scenario;
  scenario.name = family + "_" + std::to_string(dice.seed);
  scenario.description = "a whole world generated from scene seed " + std::to_string(dice.seed);
  scenario.scene = {.family = family, .scene_seed = dice.seed, .meshes = {}, .points = {}, .boxes = {}};
  scenario.duration_s = task.duration_s;
  scenario.desired_mm_per_pixel = task.mm_per_pixel;
  scenario.station_position = starts.station_W;
  for (std::size_t i = 0; i < vehicles.size(); ++i) {
    scenario.fleet.push_back({kNames[i], vehicles[i], starts.p_W[i], starts.yaw[i]});
  }
  return world;
}

}  // namespace

World draw_world(const std::string& family, std::uint64_t scene_seed, const std::filesystem::path& config_dir) {
  if (!is_drawn_world(family)) throw InputError("'" + family + "' is not a family of generated worlds");
  const std::filesystem::path dir = config_dir.empty() ? default_config_dir() : config_dir;
  const VehicleConfig explorer = load_vehicle("explorer", dir), photographer = load_vehicle("photographer", dir);
  const bool blind = family == kBlindWorld;
  for (int i = 0; i < kMostAttempts; ++i) {
    auto world = attempt(family, {scene_seed, static_cast<std::uint64_t>(i)}, blind, explorer, photographer);
    if (!world || !wild::is_flyable(world->scenario, world->scene)) continue;
    world->attempt = i;
    return std::move(*world);
  }
  throw std::runtime_error(family + " " + std::to_string(scene_seed) + ": no attempt gave a world that can be flown");
}

}  // namespace skein::sim
