#include "uav_agent/planners/flock/camera.hpp"

#include <algorithm>
#include <utility>

namespace skein::agent {
namespace {

/// A point is missing after at least this many times between pictures. Chosen: two or more pictures do not show it.
constexpr double kMissedPictures = 2.5;

}  // namespace

FlockCamera::FlockCamera(double picture_s) : missed_s_(std::max(kMissedS, kMissedPictures * picture_s)) {}

void FlockCamera::hear(bool detects, Tick now) {
  if (!detects) return;
  heard_ = now;
  since_.clear();
  missing_.clear();
  places_W_.clear();
}

void FlockCamera::expect(std::span<const std::size_t> points, const Vector3d& p_WC, Tick now) {
  if (seconds(now - std::exchange(expected_, now)) > kMostGapS) since_.clear();
  std::map<std::size_t, Tick> since;
  bool new_missing = false;
  for (const std::size_t point : points) {
    const auto before = since_.find(point);
    const Tick begin = before == since_.end() ? now : before->second;
    since.emplace(point, begin);
    if (seconds(now - begin) >= missed_s_) new_missing |= missing_.insert(point).second;
  }
  since_ = std::move(since);
  const bool known_place =
      std::ranges::any_of(places_W_, [&](const Vector3d& p_W) { return (p_W - p_WC).norm() < kApartM; });
  if (new_missing && !known_place && places_W_.size() < kPlaces) places_W_.push_back(p_WC);
}

}  // namespace skein::agent
