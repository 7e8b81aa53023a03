#include "uav_agent/flight/free_space.hpp"
#include "uav_agent/maps/occupancy_map.hpp"
#include "uav_agent/maps/world_map.hpp"
#include "uav_agent/python/module.hpp"

namespace skein::agent::python {
namespace {

class AgentsMaps final : public MapQueries {
 public:
  double resolution_m(const OccupancyMap& map) const override { return map.config().resolution_m; }
  std::uint64_t occupied_cells(const OccupancyMap& map) const override { return map.occupied_cells(); }
  std::uint64_t revision(const OccupancyMap& map) const override { return map.revision(); }
  std::uint64_t key_frames(const OccupancyMap& map) const override { return map.key_frames(); }
  bool occupied(const OccupancyMap& map, const Vector3d& p_W) const override { return map.occupied(p_W); }
  bool known_free(const OccupancyMap& map, const Vector3d& p_W, int rays) const override {
    return map.known_free(p_W, rays);
  }
  std::optional<double> distance_to_occupied(const OccupancyMap& map, const Vector3d& p_W,
                                             double max_distance) const override {
    return map.distance_to_occupied(p_W, max_distance);
  }
  bool segment_clear(const OccupancyMap& map, const Vector3d& a_W, const Vector3d& b_W, double radius) const override {
    return map.segment_clear(a_W, b_W, radius);
  }
  std::optional<double> cast(const OccupancyMap& map, const Vector3d& from_W, const Vector3d& direction,
                             double max_distance, double radius) const override {
    return map.cast(from_W, direction, max_distance, radius);
  }
  std::vector<Vector3d> occupied_in(const OccupancyMap& map, const OrientedBox& box) const override {
    std::vector<Vector3d> centres;
    map.visit_occupied(box, [&](const Vector3d& p_W) { centres.push_back(p_W); });
    return centres;
  }
  std::string octomap_bytes(const OccupancyMap& map, int rays) const override { return map.octomap_bytes(rays); }

  double cell_m(const WorldMap& map) const override { return map.config().cell_m; }
  Space at(const WorldMap& map, const Vector3d& p_W) const override { return map.at(p_W); }
  double structure_distance_m(const WorldMap& map, const Vector3d& p_W) const override {
    return map.structure_distance_m(p_W);
  }
  bool tube_free(const WorldMap& map, const Vector3d& a_W, const Vector3d& b_W, double radius_m) const override {
    return map.tube_free(a_W, b_W, radius_m);
  }
  bool ball_free(const WorldMap& map, const Vector3d& p_W, double radius_m, double lowest_m) const override {
    return map.ball_free(p_W, radius_m, lowest_m);
  }
  double clear_way_m(const WorldMap& map, const Vector3d& from_W, const Vector3d& direction_W,
                     double reach_m) const override {
    return map.clear_way_m(from_W, direction_W, reach_m);
  }
  void read_window(const WorldMap& map, const Vector3d& lowest_W, const Eigen::Vector3i& cubes,
                   std::uint8_t* spaces) const override {
    const Eigen::Vector3i lowest = map.cube_of(lowest_W);
    for (int x = 0; x < cubes.x(); ++x) {
      for (int y = 0; y < cubes.y(); ++y) {
        for (int z = 0; z < cubes.z(); ++z) {
          *spaces++ = static_cast<std::uint8_t>(map.known(lowest + Eigen::Vector3i(x, y, z)).space);
        }
      }
    }
  }
  std::vector<Vector3d> regions(const WorldMap& map) const override {
    std::vector<Vector3d> corners;
    const double edge_m = WorldMap::kRegion * WorldMap::kChunk * map.config().cell_m;
    for (const Eigen::Vector3i& region : map.regions()) corners.emplace_back(edge_m * region.cast<double>());
    return corners;
  }

  bool free(const FreeSpace& space, const Vector3d& p_W) const override { return space.free(p_W); }
  bool segment_free(const FreeSpace& space, const Vector3d& a_W, const Vector3d& b_W) const override {
    return space.segment_free(a_W, b_W);
  }
  double cost(const FreeSpace& space, const Vector3d& p_W) const override { return space.cost(p_W); }
  bool sees(const FreeSpace& space, const Vector3d& a_W, const Vector3d& b_W, double radius) const override {
    return space.sees(a_W, b_W, radius);
  }
};

}  // namespace

const MapQueries& map_queries() {
  static const AgentsMaps maps;
  return maps;
}

}  // namespace skein::agent::python
