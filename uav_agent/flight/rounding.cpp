#include "uav_agent/flight/rounding.hpp"

#include <algorithm>

namespace skein::agent {
namespace {

constexpr int kPasses = 2;                ///< a turn of 90 degrees becomes four of 22.5; chosen
constexpr double kStraightCosine = 0.95;  ///< cosine of the least turn that is rounded; chosen
constexpr double kMinLegM = 0.2;          ///< corners at shorter legs stay; chosen
constexpr double kCutsOfLeg = 3.0;        ///< geometry: the cuts at both ends leave a third of a leg

std::vector<Vector3d> cut_off(const Vector3d& from_W, const std::vector<Vector3d>& corners, double cut_m,
                              const SegmentFree& free) {
  std::vector<Vector3d> result;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector3d in = corners[i] - (i > 0 ? corners[i - 1] : from_W);
    const Vector3d out = i + 1 < corners.size() ? Vector3d(corners[i + 1] - corners[i]) : Vector3d::Zero();
    const double shorter = std::min(in.norm(), out.norm());
    const bool turns = shorter > kMinLegM && in.normalized().dot(out.normalized()) < kStraightCosine;
    const double cut = std::min(cut_m, shorter / kCutsOfLeg);
    const Vector3d before = corners[i] - cut * in.normalized(), after = corners[i] + cut * out.normalized();
    if (turns && free(before, after)) {
      result.push_back(before);
      result.push_back(after);
    } else {
      result.push_back(corners[i]);
    }
  }
  return result;
}

}  // namespace

std::vector<Vector3d> rounded(const Vector3d& from_W, const std::vector<Vector3d>& corners_W, double cut_m,
                              const SegmentFree& free) {
  std::vector<Vector3d> way = corners_W;
  for (int pass = 0; pass < kPasses; ++pass) way = cut_off(from_W, way, cut_m, free);
  return way;
}

}  // namespace skein::agent
