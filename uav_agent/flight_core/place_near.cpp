#include "uav_agent/flight_core/place_near.hpp"

#include "uav_agent/maps/cube_steps.hpp"

namespace skein::agent {
namespace {

constexpr double kDistancesM[] = {1.0, 2.0, 3.0};  ///< of the places that are tried; chosen

}  // namespace

std::optional<Vector3d> best_place_near_W(const Vector3d& p_W, double lowest_m, double least,
                                          const std::function<double(const Vector3d& p_W)>& value, SafetyFilter& filter,
                                          const SafetyFilter::Facts& facts) {
  std::optional<Vector3d> best_W;
  for (const double step_m : kDistancesM) {
    for (int i = 0; i < kCubesAround; ++i) {
      const Vector3d along = step_around(i).cast<double>();
      const Vector3d place_W = p_W + along.normalized() * step_m;
      if (along.isZero() || place_W.z() < lowest_m) continue;
      const double its_value = value(place_W);
      if (its_value <= least || filter.would_hold({place_W}, facts).by != Held::By::nothing) continue;
      least = its_value;
      best_W = place_W;
    }
  }
  return best_W;
}

}  // namespace skein::agent
