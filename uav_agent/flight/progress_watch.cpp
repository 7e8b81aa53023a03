#include "uav_agent/flight/progress_watch.hpp"

namespace skein::agent {
namespace {

constexpr double kBetter = 0.01;                 ///< of a score: less is no news
constexpr std::uint32_t kMostPoints = 1U << 20;  ///< of a scene; a number beyond is no order

}  // namespace

void ProgressWatch::update(const PlannerInput& in, bool retreats) {
  if ((in.state.p_WB - here_W_).norm() > kMovedM) {
    here_W_ = in.state.p_WB;
    here_since_ = in.tick;
  }
  if (retreats) stood_W_ = in.state.p_WB;
  bool news = (in.state.p_WB - stood_W_).norm() > kMovedM;
  for (const DetectedPoint& point : in.detected) {
    if (point.order >= kMostPoints) continue;
    if (point.order >= best_.size()) best_.resize(point.order + 1, 0.0);
    news |= point.score > best_[point.order] + kBetter;
    best_[point.order] = std::max(best_[point.order], point.score);
  }
  if (news) forgive(in);
}

void ProgressWatch::forgive(const PlannerInput& in) {
  stood_W_ = in.state.p_WB;
  since_ = in.tick;
}

}  // namespace skein::agent
