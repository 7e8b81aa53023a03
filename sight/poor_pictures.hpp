// The best picture of each interest point that no picture of the fleet has shown well enough to count. Explains losses
// only (docs/results.md, Losses); no score and no digest depends on it. One small record for each point of the scene.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace skein::sim {

/// A point in a picture that does not count for it, because its quality is too low.
struct PoorSight {
  std::uint32_t point = 0;
  float q = 0.0F, q_blur = 0.0F, q_res = 0.0F, q_distance = 0.0F;  ///< as in Detection
  bool operator==(const PoorSight&) const = default;
};

/// Not thread-safe; cameras in several threads may read it while no thread changes it.
class PoorPictures {
 public:
  /// @param points  number of interest points in the scene.
  explicit PoorPictures(std::size_t points) : best_(points) {}

  /// Whether a picture that shows the point with this quality, too low to count, would be the best one so far. Of
  /// equals the first one stays.
  bool would_be_best(std::uint32_t point, float q) const { return q > best_[point].q; }
  void add(const PoorSight& sight) {
    if (would_be_best(sight.point, sight.q))
      best_[sight.point] = {sight.q, sight.q_blur, sight.q_res, sight.q_distance};
  }
  /// A picture counts for the point: no other one matters any more.
  void close(std::uint32_t point) { best_[point].q = kClosed; }

  /// nullopt: a picture counted for the point, or none showed it, or its quality was undefined in all of them.
  std::optional<PoorSight> best(std::uint32_t point) const {
    const Qualities& its = best_[point];
    if (its.q == kNone || its.q == kClosed) return std::nullopt;
    return PoorSight{point, its.q, its.q_blur, its.q_res, its.q_distance};
  }
  std::size_t size() const { return best_.size(); }  ///< points

 private:
  static constexpr float kNone = -1.0F, kClosed = std::numeric_limits<float>::infinity();
  struct Qualities {
    float q = kNone, q_blur = 0.0F, q_res = 0.0F, q_distance = 0.0F;
  };
  std::vector<Qualities> best_;  ///< by point
};

}  // namespace skein::sim
