#include "core/scoring/score_table.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace skein {
namespace {

/// The order in which captures of one point rank, best first.
bool ranks_before(const PointTally& a, const PointTally& b) {
  if (a.q != b.q) {
    return a.q > b.q;
  }
  if (a.tick != b.tick) {
    return a.tick < b.tick;
  }
  if (a.uav != b.uav) {
    return a.uav < b.uav;
  }
  return a.capture < b.capture;
}

}  // namespace

ScoreTable::ScoreTable(std::size_t uavs, std::size_t points, const RulesConfig& rules)
    : min_score_(static_cast<float>(rules.min_point_score)),
      collision_voids_(rules.collision_voids_score),
      void_(uavs, false),
      of_uav_(uavs),
      standing_(points) {}

PointTally ScoreTable::best_of_fleet(std::uint32_t point) const {
  PointTally best;
  for (const UavIndex uav : FirstUavs(of_uav_.size())) {
    const auto candidate = of_uav_[uav].find(point);
    if (!void_[uav] && candidate != of_uav_[uav].end() && ranks_before(candidate->second, best)) {
      best = candidate->second;
    }
  }
  return best;
}

std::vector<TallyChange> ScoreTable::add(const CaptureReport& report) {
  auto& own = of_uav_.at(report.uav);
  for (const CapturePoint& point : report.points) {
    if (point.index >= standing_.size()) {
      throw std::out_of_range("interest point " + std::to_string(point.index) + " of " +
                              std::to_string(standing_.size()));
    }
  }
  std::vector<TallyChange> changes;
  for (const CapturePoint& point : report.points) {
    const PointTally candidate{point.q, report.uav, report.capture, report.tick};
    if (!(point.q >= min_score_)) {
      continue;
    }
    PointTally& best = own[point.index];
    if (!ranks_before(candidate, best)) {
      continue;
    }
    best = candidate;
    PointTally& standing = standing_[point.index];
    if (!void_[report.uav] && ranks_before(candidate, standing)) {
      standing = candidate;
      changes.push_back({point.index, candidate});
    }
  }
  return changes;
}

std::vector<TallyChange> ScoreTable::collide(UavIndex uav) {
  std::vector<TallyChange> changes;
  if (void_.at(uav) || !collision_voids_) {
    return changes;
  }
  void_[uav] = true;
  for (std::uint32_t point = 0; point < standing_.size(); ++point) {
    if (standing_[point].q > 0.0F && standing_[point].uav == uav) {
      standing_[point] = best_of_fleet(point);
      changes.push_back({point, standing_[point]});
    }
  }
  return changes;
}

double ScoreTable::score() const {
  double sum = 0.0;
  for (const double part : score_by_uav()) {
    sum += part;
  }
  return sum;
}

std::vector<double> ScoreTable::score_by_uav() const {
  std::vector<double> scores(of_uav_.size(), 0.0);
  for (const PointTally& tally : standing_) {
    if (tally.q > 0.0F) {
      scores[tally.uav] += tally.q;
    }
  }
  return scores;
}

std::size_t ScoreTable::points_detected() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(standing_, [](const PointTally& tally) { return tally.q >= kDetectedQuality; }));
}

}  // namespace skein
