#include "uav_agent/planners/kios/mapping.hpp"

#include <algorithm>

namespace skein::agent {
namespace {

constexpr int kMostFailures = 4;  ///< a corner that fails more often is skipped; chosen
constexpr double kRetryS = 1.0;   ///< wait after a failure; chosen

}  // namespace

void KiosMapping::step(const PlannerInput& in, std::int64_t& id, PlannerOutput& out) {
  for (const Outcome& outcome : in.flight.outcomes) {
    if (asked_ > 0 && outcome.id == goal_) handle_outcome(outcome, in.tick);
  }
  if (asked_ > 0 || left_W_.empty() || in.tick < not_before_) return;
  asked_ = left_W_.size() % 2 == 0 ? 2 : 1;
  Goal& goal = out.goals.emplace().emplace_back();
  goal.id = goal_ = ++id;
  for (std::size_t i = 0; i < asked_; ++i) goal.way.push_back({left_W_[i], speed_mps_});
}

void KiosMapping::handle_outcome(const Outcome& outcome, Tick now) {
  const bool reached = outcome.kind == Outcome::Kind::reached;
  const std::size_t passed = std::min(reached ? asked_ : outcome.leg, left_W_.size());
  left_W_.erase(left_W_.begin(), left_W_.begin() + static_cast<std::ptrdiff_t>(passed));
  asked_ = 0;
  if (passed > 0) failures_ = 0;
  if (reached) return;
  not_before_ = now + ticks(kRetryS);
  if (++failures_ <= kMostFailures || left_W_.empty()) return;
  failures_ = 0;
  left_W_.pop_front();
}

}  // namespace skein::agent
