#include "uav_agent/planners/flock/work.hpp"

#include <algorithm>
#include <numeric>

namespace skein::agent {
namespace {

constexpr double kPointsPerS = 1.2;  ///< points that a UAV photographs where there are enough; chosen

}  // namespace

void FlockWork::note(double rate) {
  rate_ += kRateShare * (rate - rate_);
  best_rate_ = std::max(best_rate_, rate_);
}

double FlockWork::lack(const std::vector<double>& others, const FlockTargets& targets, double left_s,
                       std::size_t uavs) const {
  const double promised = std::accumulate(others.begin(), others.end(), 0.0);
  const double pays = (rate_ + promised) / (1.0 + static_cast<double>(others.size())) / best_rate_;
  double open = 0.0;
  for (const FlockTarget& target : targets.all()) open += target.open();
  const double capacity = kPointsPerS * left_s * static_cast<double>(uavs);
  return std::clamp(1.0 - std::min(open / std::max(1.0, capacity), pays), 0.0, 1.0);
}

}  // namespace skein::agent
