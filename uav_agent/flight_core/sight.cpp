#include "uav_agent/flight_core/sight.hpp"

namespace skein::agent {
namespace {

constexpr double kScanLostS = 3.0;      ///< a LiDAR without a scan for so long has failed; it scans at 10 Hz
constexpr std::size_t kOwnRegions = 8;  ///< a map with no more regions holds only the space around the UAV's start

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
  const std::size_t regions = in.world_map->regions().size();
  if (regions != told_regions_ || !told_at_) told_at_ = in.tick;
  told_regions_ = regions;
  if (told_regions_ > kOwnRegions) {
    // Otherwise the UAV would be shut in where it is, because nobody proved the space between there and the map.
    if (filter.assumes_boxes() && !filter.proved_free(in.state.p_WB, *in.world_map)) return;
    return filter.assume_boxes(false);
  }
  if (seconds(in.tick - *told_at_) > config_.alone_s) filter.assume_boxes(true);
}

}  // namespace skein::agent
