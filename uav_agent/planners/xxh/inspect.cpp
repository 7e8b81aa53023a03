#include "uav_agent/planners/xxh/inspect.hpp"

#include <algorithm>

#include "uav_agent/planning/aiming.hpp"

namespace skein::agent {
namespace {

constexpr std::size_t kCandidates = 4;  ///< most cells offered to the flight core at once; chosen
constexpr int kPasses = 3;              ///< over a section's layers, for cells that could not be reached before; chosen

}  // namespace

void XxhInspector::begin(const XxhRegionMap::Section& section) {
  layers_.clear();
  const int step = *config_.layer_step;
  for (int layer = section.first + step / 2; layer < section.last; layer += step) layers_.push_back(layer);
  if (layers_.empty() && section.first < section.last) layers_.push_back(section.first);
  all_layers_.assign(layers_.begin(), layers_.end());
  pass_ = 0;
  failed_.clear();
  last_cell_.reset();
  leave();
}

std::vector<Goal> XxhInspector::choices(const XxhRegionMap& region, const Vector3d& here_W, const FreeSpace& space) {
  const XxhOrder order = *config_.order;
  const bool goes_on = order == XxhOrder::spiral && last_cell_;
  const Vector3d from_W = goes_on ? region.grid().centre_W(*last_cell_) : here_W;
  choices_ = region.visits(from_W, layers_.front(), order, space, failed_, kCandidates);
  std::vector<Goal> goals;
  for (const XxhVisit& visit : choices_) {
    Goal& goal = goals.emplace_back();
    goal.way = {{visit.p_WB, config_.flight.approach_mps}};
    goal.yaw = yaw_facing(visit.targets.front().out_W);
    goal.gimbal = visit.targets.front().surface_W;
  }
  if (!goals.empty()) return goals;
  layers_.pop_front();
  if (layers_.empty() && ++pass_ < kPasses) {
    layers_.assign(all_layers_.begin(), all_layers_.end());
    failed_.clear();
  }
  return goals;
}

void XxhInspector::hear(const XxhErrand& errand) {
  for (const std::size_t missed : errand.missed()) failed_.insert(choices_[missed].cell);
  const auto& end = errand.ended();
  if (!end) return;
  if (end->reached) {
    visit_ = choices_[end->choice];
    last_cell_ = visit_->cell;
  } else {
    failed_.insert(choices_[end->choice].cell);
  }
}

const XxhTarget* XxhInspector::ahead(std::size_t choice, const XxhRegionMap& region) const {
  const XxhVisit& visit = choices_[choice];
  return region.targets(visit.cell).empty() ? nullptr : &visit.targets.front();
}

void XxhInspector::leave() {
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

/// Marks the first target and goes on to the next one; ends the visit after the last one.
void XxhInspector::next_target(VoxelGrid& grid) {
  grid.mark(target().cube, target().face);
  reached_since_.reset();
  visit_->targets.erase(visit_->targets.begin());
  if (visit_->targets.empty()) visit_.reset();
}

}  // namespace skein::agent
