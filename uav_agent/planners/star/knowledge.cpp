#include "uav_agent/planners/star/knowledge.hpp"

#include "uav_agent/planning/strips.hpp"

namespace skein::agent {
namespace {

constexpr double kFreeAroundM = 0.5;             ///< radius around a cube's centre that must be free; chosen
constexpr std::size_t kExplorersLooks = 20'000;  ///< most unknown cubes that an explorer examines per update; chosen
constexpr std::size_t kOthersLooks = 4'000;      ///< the same for other UAVs, which need free space less soon; chosen

VoxelGrid first_grid(const StarConfig& config, const AgentConfig& agent, const std::vector<OrientedBox>& boxes,
                     double sharp_m) {
  VoxelGrid grid = star_grid(boxes, config, sharp_m);
  if (!agent.first_explorer()) fill_boxes(boxes, grid);
  return grid;
}

double sharp_distance_m(const AgentConfig& agent) {
  return camera_reach(agent.vehicle.camera, agent.desired_mm_per_pixel).sharp_distance_m;
}

}  // namespace

StarKnowledge::StarKnowledge(const StarConfig& config, const AgentConfig& agent, const std::vector<OrientedBox>& boxes,
                             const std::vector<std::size_t>& own_boxes)
    : agent_(agent),
      voxels_(
          {.around_m = kFreeAroundM, .max_looks = agent.me().role == Role::explorer ? kExplorersLooks : kOthersLooks}),
      grid_(first_grid(config, agent, boxes, sharp_distance_m(agent))),
      cubes_(cubes_of_boxes(grid_, boxes, own_boxes)),
      surfaces_(surfaces_config(config, agent.vehicle, sharp_distance_m(agent)), agent.vehicle, grid_),
      explorer_(explorer_config(config), grid_) {}

void StarKnowledge::look_at_map(const WorldMap& map, const Vector3d& p_WB) {
  voxels_.update(map, grid_);
  const std::vector<VoxelGrid::Id> changed = grid_.take_changed();
  if (agent_.me().role == Role::explorer) explorer_.look(grid_, changed, p_WB);
}

void StarKnowledge::look_at_picture(const RigidBodyState& state, const GimbalState& gimbal) {
  surfaces_.mark_seen(state, gimbal, voxels_, grid_);
}

std::vector<StarView> StarKnowledge::views(const FreeSpace& space, const Vector3d& p_W, Tick now) {
  return surfaces_.views(grid_, cubes_, voxels_, space, p_W, now);
}

std::optional<Vector3d> StarKnowledge::nearest_open_W(const Vector3d& p_W) const {
  return surfaces_.nearest_open_W(grid_, voxels_, p_W);
}

}  // namespace skein::agent
