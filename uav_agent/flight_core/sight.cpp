#include "uav_agent/flight_core/sight.hpp"

namespace skein::agent {
namespace {

constexpr double kScanLostS = 3.0;  ///< a LiDAR without a scan for this time has failed; chosen: 30 scans of the sensor
/// A map with no more regions holds only the space around the UAV's start. Geometry: this many meet at a corner.
constexpr std::size_t kOwnRegions = 8;

}  // namespace

OwnSight::OwnSight(const AgentConfig& agent) : agent_(agent), sees_(agent.me().role == Role::explorer) {}

void OwnSight::update(const PlannerInput& in) {
  if (agent_.me().role != Role::explorer) return;
  if (in.scanned || !scanned_at_) scanned_at_ = in.tick;
  sees_ = seconds(in.tick - *scanned_at_) <= kScanLostS;
}

void ToldSpace::listen(const PlannerInput& in, bool sees, SafetyFilter& filter) {
  if (!agent_.first_explorer()) return;
  if (sees) return filter.assume_boxes(false);
  const std::uint64_t changes = in.world_map->changes();
  if (changes != told_changes_ || !told_at_) told_at_ = in.tick;
  told_changes_ = changes;
  has_left_ = has_left_ || (in.state.p_WB - agent_.me().p_WB_start).norm() > kLeftStartM;
  const bool told = in.world_map->regions().size() > kOwnRegions;
  if (filter.assumes_boxes()) {
    // Where no beam has proved the space between the UAV and the rest of the map, the UAV would be shut in.
    if (told && has_left_ && filter.proved_free(in.state.p_WB, *in.world_map)) filter.assume_boxes(false);
    return;
  }
  const bool may_assume = !told || !has_left_;
  if (may_assume && seconds(in.tick - *told_at_) > config_.alone_s) filter.assume_boxes(true);
}

}  // namespace skein::agent
