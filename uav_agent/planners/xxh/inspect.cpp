#include "uav_agent/planners/xxh/inspect.hpp"

#include <algorithm>

#include "uav_agent/planning/aiming.hpp"

namespace skein::agent {
namespace {

constexpr std::size_t kCandidates = 4;
constexpr int kPasses = 3;

}  // namespace

void XxhInspector::begin(const XxhRegionMap::Section& section) {
  layers_.clear();
  for (int layer = section.first + config_.layer_step / 2; layer < section.last; layer += config_.layer_step) {
    layers_.push_back(layer);
  }
  if (layers_.empty() && section.first < section.last) layers_.push_back(section.first);
  all_layers_.assign(layers_.begin(), layers_.end());
  pass_ = 0;
  visit_.reset();
  failed_.clear();
}

std::vector<XxhVisit> XxhInspector::candidates(const XxhRegionMap& region, const Vector3d& here_W,
                                               const FreeSpace& space) {
  auto visits = region.nearest_visits(here_W, layers_.front(), space, failed_, kCandidates);
  if (!visits.empty()) return visits;
  layers_.pop_front();
  if (layers_.empty() && ++pass_ < kPasses) {
    layers_.assign(all_layers_.begin(), all_layers_.end());
    failed_.clear();
  }
  return {};
}

void XxhInspector::give_up() {
  if (!visit_) return;
  failed(visit_->cell);
  visit_.reset();
  at_cell_since_.reset();
  reached_since_.reset();
}

void XxhInspector::look(const PlannerInput& in, VoxelGrid& grid) {
  if (!at_cell_since_) at_cell_since_ = in.tick;
  const bool steady = in.state.v_WB.norm() < config_.settle_mps;
  const bool aimed = aim_error(target().surface_W, in.state, in.gimbal, agent_.vehicle) < config_.aim_rad;
  if (!steady || !aimed) reached_since_.reset();
  if (steady && aimed && !reached_since_) reached_since_ = in.tick;
  if (reached_since_ && seconds(in.tick - *reached_since_) >= config_.dwell_s) next_target(grid);
  if (visit_ && seconds(in.tick - *at_cell_since_) < config_.cell_s) return;
  while (visit_) next_target(grid);
  at_cell_since_.reset();
}

/// The first target is done with; so is the cell when it was the last.
void XxhInspector::next_target(VoxelGrid& grid) {
  grid.mark(target().cube, target().face);
  reached_since_.reset();
  visit_->targets.erase(visit_->targets.begin());
  if (visit_->targets.empty()) visit_.reset();
}

}  // namespace skein::agent
