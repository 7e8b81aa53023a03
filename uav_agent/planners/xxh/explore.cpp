#include "uav_agent/planners/xxh/explore.hpp"

#include <algorithm>

namespace skein::agent {
namespace {

constexpr double kPassedM = 3.0;       ///< a place nearer than this counts as passed; chosen
constexpr std::size_t kChain = 12;     ///< most places in one goal; chosen
constexpr std::size_t kChoices = 3;    ///< most goals offered, each beginning at another place; chosen
constexpr int kShifts = 2;             ///< most shifts of a place outwards; chosen
constexpr double kShiftM = 4.0;        ///< length of such a shift; chosen
constexpr double kInwardsShare = 0.6;  ///< size of the part of the box that the camera looks at; chosen

/// The nearest point of a box that is scaled by `share` about its middle.
Vector3d nearest_in_box(const OrientedBox& box, const Vector3d& p_W, double share) {
  const Vector3d inside = 0.5 * share * box.size;
  const Vector3d p_O = (box.R_WO.transpose() * (p_W - box.center)).cwiseMax(-inside).cwiseMin(inside);
  return box.center + box.R_WO * p_O;
}

}  // namespace

void XxhExplorer::stop() {
  places_.clear();
  put_off_.clear();
  again_ = false;
  got_nowhere_ = false;
}

void XxhExplorer::begin(const XxhRegionMap& region, const XxhRegionMap::Section& section, double at_most_s,
                        const PlannerInput& in) {
  section_ = section;
  since_ = in.tick;
  until_ = in.tick + ticks(at_most_s);
  lay_out(region, in);
}

bool XxhExplorer::finished(const XxhRegionMap& region, const PlannerInput& in) {
  if (late(in)) stop();
  if (!places_.empty() || !put_off_.empty()) return false;
  if (!got_nowhere_ || seconds(in.tick - since_) >= *config_.retry_s) return true;
  lay_out(region, in);
  return false;
}

void XxhExplorer::lay_out(const XxhRegionMap& region, const PlannerInput& in) {
  stop();
  if (region.is_empty(section_)) return;
  for (Vector3d place : region.spiral(section_, in.tracking.setpoint.p_WB, *config_.first_turn)) {
    const Vector3d out = place - nearest_in_box(region.box(), place, 1.0);
    const auto taken = [&] {
      return !in.space->free(place) ||
             std::ranges::any_of(in.boxes, [&](const OrientedBox& box) { return box.contains(place); });
    };
    for (int shift = 0; shift < kShifts && taken(); ++shift) place += kShiftM * out.normalized();
    if (!taken()) places_.push_back(place);
  }
  got_nowhere_ = !places_.empty();
}

void XxhExplorer::look_inwards(const XxhRegionMap& region, const PlannerInput& in, PlannerOutput& out) {
  const Vector3d here = in.tracking.setpoint.p_WB;
  out.gimbal = nearest_in_box(region.box(), here, kInwardsShare);
  while (!places_.empty() && (places_.front() - here).norm() < kPassedM) {
    places_.pop_front();
    passed_ = true;
    got_nowhere_ = false;
  }
  if (!places_.empty()) return;
  if (again_) put_off_.clear();
  again_ = true;
  places_.swap(put_off_);
}

void XxhExplorer::hear(const XxhErrand& errand) {
  for (const std::size_t missed : errand.missed()) put_off(errand.choice(missed).way.front().p_WB);
  if (errand.ended() && !passed_ && !places_.empty()) put_off(places_.front());
}

void XxhExplorer::put_off(const Vector3d& place_W) {
  if (places_.empty() || places_.front() != place_W) return;
  put_off_.push_back(place_W);
  places_.pop_front();
}

std::vector<Goal> XxhExplorer::choices(const FreeSpace& space) {
  passed_ = false;
  std::vector<Goal> goals;
  for (std::size_t first = 0; first < std::min(kChoices, places_.size()); ++first) {
    Goal& goal = goals.emplace_back();
    for (std::size_t i = first; i < places_.size() && goal.way.size() < kChain; ++i) {
      if (i > first && !space.segment_free(places_[i - 1], places_[i])) break;
      goal.way.push_back({places_[i], config_.explore_mps});
    }
  }
  return goals;
}

}  // namespace skein::agent
