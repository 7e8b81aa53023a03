#include "scenes/district.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/math/euler.hpp"
#include "core/math/random_stream.hpp"
#include "core/scenario/drawn_worlds.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "scenes/mesh_builder.hpp"
#include "scenes/surface_sampling.hpp"
#include "scenes/wild/shapes.hpp"

namespace skein::sim {
namespace {

constexpr std::size_t kUavsPerLot = 5, kExplorersPerLot = 2;
constexpr std::size_t kPointsPerLot = 300;
constexpr double kLot_m = 48.0;  ///< from the middle of a street to that of the next one
constexpr double kStartSpacing_m = 4.5;
constexpr double kFirstStart_m = 3.0;  ///< from the crossing of the streets, along both
constexpr double kRadio_m = 40.0;      ///< between UAVs
constexpr double kMastShare = 0.2;     ///< height of the mast, as a share of the district's side, besides kLeastMast_m
constexpr double kLeastMast_m = 25.0;

/// Column and row of the square with this number in a grid with this many columns.
Vector2d square(std::size_t number, std::size_t columns) {
  const std::size_t column = number % columns, row = number / columns;
  return {static_cast<double>(column), static_cast<double>(row)};
}

/// The building of a lot, and the box around it.
void add_building(Scene& scene, const Vector2d& middle_W, std::size_t lot, RandomStream& random) {
  const auto kinds = wild::solid_kinds();
  const auto& kind = kinds[static_cast<std::size_t>(random.uniform() * static_cast<double>(kinds.size()))];
  const Vector3d size(random.uniform(9.0, 15.0), random.uniform(7.0, 12.0), random.uniform(8.0, 22.0));
  const double heading = random.uniform(-0.3, 0.3);
  const Isometry3d X_WS = standing_at(middle_W, heading);
  MeshBuilder builder;
  kind.add(builder, X_WS, size, random);
  scene.boxes.push_back(enclosing_box(fmt::format("lot_{}", lot), builder.mesh(), 0, X_WS.linear(), kBoxMargin));
  append(scene.mesh, builder.mesh());
}

}  // namespace

World draw_district(std::uint64_t scene_seed, std::size_t uavs, const std::filesystem::path& config_dir) {
  const std::filesystem::path dir = config_dir.empty() ? default_config_dir() : config_dir;
  const VehicleConfig explorer = load_vehicle("explorer", dir), photographer = load_vehicle("photographer", dir);
  const std::size_t lots = (uavs + kUavsPerLot - 1) / kUavsPerLot;
  const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(lots))));
  World world;
  Scenario& scenario = world.scenario;
  for (std::size_t lot = 0; lot < lots; ++lot) {
    RandomStream random(scene_seed, "district", lot);
    const Vector2d crossing_W = kLot_m * square(lot, side);
    add_building(world.scene, crossing_W + Vector2d::Constant(0.5 * kLot_m), lot, random);
    for (std::size_t i = 0; i < kUavsPerLot && scenario.fleet.size() < uavs; ++i) {
      const Vector2d start_W = crossing_W + Vector2d::Constant(kFirstStart_m) + kStartSpacing_m * square(i, 3);
      scenario.fleet.push_back({fmt::format("uav{:04}", scenario.fleet.size() + 1),
                                i < kExplorersPerLot ? explorer : photographer, start_W, 0.25 * std::numbers::pi});
    }
  }
  world.scene.points = sample_surface(world.scene.mesh, world.scene.boxes, kPointsPerLot * lots, scene_seed);
  scenario.name = fmt::format("{}_{}_{}", kDistrict, scene_seed, uavs);
  scenario.description = fmt::format("a district for {} UAVs, generated from scene seed {}", uavs, scene_seed);
  scenario.scene = {.family = kDistrict, .scene_seed = scene_seed, .meshes = {}, .points = {}, .boxes = {}};
  scenario.duration_s = 300.0;
  scenario.desired_mm_per_pixel = 3.0;
  LinkEffect& radio = scenario.links.emplace_back();
  radio.from = radio.to = {"uavs"};
  radio.range_m = kRadio_m;
  const double crossing = kLot_m * std::floor(0.5 * static_cast<double>(side));
  const double mast_m = kLeastMast_m + kMastShare * kLot_m * static_cast<double>(side);
  scenario.station_position = {crossing - 2.0, crossing - 2.0, mast_m};
  return world;
}

}  // namespace skein::sim
