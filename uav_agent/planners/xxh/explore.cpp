#include "uav_agent/planners/xxh/explore.hpp"

#include <algorithm>
#include <cmath>

namespace skein::agent {
namespace {

constexpr double kPassedM = 3.0;    ///< so near, a place counts as passed
constexpr std::size_t kChain = 12;  ///< places that are flown in one go
constexpr int kPlacesTried = 3;     ///< of places, in one exchange
constexpr double kLiftM = 5.0;      ///< between the heights that are tried above a low place
constexpr double kAboveM = 0.3;     ///< above the height below which space must have been seen
constexpr int kShifts = 2;          ///< of a place, outwards
constexpr double kShiftM = 4.0;
constexpr double kGetsOutS = 30.0;     ///< of a corner from which no place of a section can be reached
constexpr double kInwardsShare = 0.6;  ///< of the box: what the camera looks at

/// The nearest place in a box, made smaller about its middle.
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
  if (!config_.faithful && in.tick > until_) stop();
  if (!places_.empty() || !put_off_.empty()) return false;
  if (config_.faithful || !got_nowhere_ || seconds(in.tick - since_) > kGetsOutS) return true;
  lay_out(region, in);
  return false;
}

void XxhExplorer::lay_out(const XxhRegionMap& region, const PlannerInput& in) {
  stop();
  if (region.is_empty(section_)) return;
  for (Vector3d place : region.spiral(section_, in.tracking.setpoint.p_WB, config_.faithful)) {
    const Vector3d out = place - nearest_in_box(region.box(), place, 1.0);
    const auto taken = [&] {
      return in.map.any_occupied_within(place, ways_.clearance_m()) ||
             std::ranges::any_of(in.boxes, [&](const OrientedBox& box) { return box.contains(place); });
    };
    for (int shift = 0; shift < kShifts && taken(); ++shift) place += kShiftM * out.normalized();
    if (!taken()) places_.push_back(place);
  }
  got_nowhere_ = !places_.empty();
}

void XxhExplorer::look_inwards(const XxhRegionMap& region, const PlannerInput& in, PlannerOutput& out) {
  const Vector3d here = in.tracking.setpoint.p_WB;
  const Vector3d inwards = nearest_in_box(region.box(), here, kInwardsShare);
  out.gimbal = inwards;
  if ((inwards - here).head<2>().norm() > 1.0) out.yaw = std::atan2(inwards.y() - here.y(), inwards.x() - here.x());
  while (!places_.empty() && (places_.front() - here).norm() < kPassedM) {
    places_.pop_front();
    got_nowhere_ = false;
  }
  if (!places_.empty()) return;
  if (again_) put_off_.clear();
  again_ = true;
  places_.swap(put_off_);
}

bool XxhExplorer::set_out(const PlannerInput& in, PlannerOutput& out) {
  for (int tries = 0; tries < kPlacesTried && !places_.empty(); ++tries) {
    const auto count = static_cast<std::ptrdiff_t>(std::min(kChain, places_.size()));
    if (ways_.fly_along({places_.begin(), places_.begin() + count}, config_.explore_mps, in, out)) return true;
    if (!again_ && look_from_above(places_.front(), in, out)) return true;
    put_off_.push_back(places_.front());
    places_.pop_front();
  }
  return false;
}

void XxhExplorer::give_up() {
  if (!places_.empty()) places_.pop_front();
}

/// From the lowest height above the place that can be reached; once, and only where it is low.
bool XxhExplorer::look_from_above(const Vector3d& place_W, const PlannerInput& in, PlannerOutput& out) {
  const double highest = ways_.site().safe_height_m() + kAboveM;
  if (place_W.z() >= highest || looked_down_at_ == place_W) return false;
  looked_down_at_ = place_W;
  for (double z = std::min(place_W.z() + kLiftM, highest);; z = std::min(z + kLiftM, highest)) {
    const Vector3d above(place_W.x(), place_W.y(), z);
    const bool there = (above - in.tracking.setpoint.p_WB).norm() < kPassedM;
    if (!there && ways_.fly_to(above, config_.transit_mps, in, out)) return true;
    if (z >= highest) return false;
  }
}

}  // namespace skein::agent
