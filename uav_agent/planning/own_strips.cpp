#include "uav_agent/planning/own_strips.hpp"

#include <algorithm>
#include <tuple>

namespace skein::agent {
namespace {

constexpr double kAgainS = 15.0;  ///< time after which next() offers a strip again that the UAV could not fly; chosen

}  // namespace

OwnStrips::OwnStrips(const WorkShare& share) {
  for (const Visit& visit : share.tour) records_.push_back({.strip = share.strips[visit.strip]});
}

std::optional<std::size_t> OwnStrips::next(Tick now, const Vector3d& p_WB) const {
  std::optional<std::size_t> best;
  std::tuple<int, double> least;
  for (std::size_t i = 0; i < records_.size(); ++i) {
    const Record& record = records_[i];
    if (now < record.not_before) continue;
    const double off_m = std::min((record.strip.begin_W - p_WB).norm(), (record.strip.end_W - p_WB).norm());
    const std::tuple rank(record.flown, off_m);
    if (!best || rank < least) {
      best = i;
      least = rank;
    }
  }
  return best;
}

bool OwnStrips::begins_at_end(std::size_t number, const Vector3d& p_WB) const {
  const Strip& strip = records_[number].strip;
  return (strip.end_W - p_WB).norm() < (strip.begin_W - p_WB).norm();
}

void OwnStrips::failed(std::size_t number, Tick now) { records_[number].not_before = now + ticks(kAgainS); }

}  // namespace skein::agent
