#include "uav_agent/planning/standoff.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace skein::agent {
namespace {

constexpr double kOutsideM = 4.0;     ///< casts begin this far outside the face; chosen
constexpr double kCastRadiusM = 0.8;  ///< chosen: wide enough not to slip between the hits of a sparse map
constexpr double kSearchStepM = 0.5;  ///< from one tried stand-off to the next; chosen
constexpr double kSearchInM = 4.0, kSearchOutM = 7.0;      ///< range of tried stand-offs around the desired one; chosen
constexpr double kAsideM[] = {0.0, -1.5, 1.5, -3.0, 3.0};  ///< tried offsets across the strip; chosen
constexpr double kAsideCost = 3.0;                         ///< per metre of offset; chosen
/// Per metre too near (too far: 1): the image covers less of the surface. Chosen.
constexpr double kTooNearCost = 2.0;
constexpr double kBendCost = 0.5;       ///< per metre of difference to the sample before; chosen
constexpr double kSteepest = 1.2;       ///< change of stand-off per metre along the strip; chosen
constexpr double kBendRounding = 1e-9;  ///< numeric
constexpr double kUnknownDepthM = 3.0;  ///< assumed for the speed only, where the map knows no surface; chosen

/// What is desired at one point of the strip.
struct Sample {
  double s = 0.0;  ///< distance along the strip in the direction of flight [m]
  Vector3d face_W;
  double depth = 0.0;  ///< of the surface behind the face, or kUnknownDepthM [m]
  double wish = 0.0;   ///< desired distance from the face, outwards [m]
};

/// A place for the UAV: `standoff` metres outside the face, `aside` metres across the strip.
struct Place {
  double standoff = 0.0, aside = 0.0;
  Vector3d p_W = Vector3d::Zero();
};

Sample sample_at(const Strip& strip, bool reversed, double s, const FreeSpace& space, const CameraReach& reach,
                 const StandoffConfig& config) {
  const Vector3d from = reversed ? strip.end_W : strip.begin_W, to = reversed ? strip.begin_W : strip.end_W;
  Sample sample{.s = s, .face_W = from + (to - from).normalized() * s};
  const auto depth = space.config().use_map ? surface_depth(strip, sample.face_W, space.map()) : std::nullopt;
  sample.depth = depth.value_or(kUnknownDepthM);
  sample.wish = depth ? config.ratio * reach.sharp_distance_m - *depth : config.blind_ratio * reach.sharp_distance_m;
  return sample;
}

/// The cheapest free place, by its deviation from the desired one, that can be reached from the place before.
std::optional<Place> choose(const Sample& sample, const Strip& strip, const Place* before, const FreeSpace& space,
                            double step_m) {
  std::optional<Place> best;
  double best_cost = 0.0;
  const int in = static_cast<int>(kSearchInM / kSearchStepM), out = static_cast<int>(kSearchOutM / kSearchStepM);
  for (const double aside : kAsideM) {
    for (int j = -in; j <= out; ++j) {
      Place place{sample.wish + j * kSearchStepM, aside, {}};
      double cost = (j < 0 ? -kTooNearCost * j : j) * kSearchStepM + kAsideCost * std::abs(aside);
      if (before) {
        const double bend = std::hypot(place.standoff - before->standoff, place.aside - before->aside);
        if (bend > kSteepest * step_m + kBendRounding) continue;
        cost += kBendCost * bend;
      }
      if (best && cost >= best_cost) continue;
      place.p_W = sample.face_W + place.standoff * strip.out_W + aside * strip.across_W;
      if (!space.free(place.p_W) || (before && !space.segment_free(before->p_W, place.p_W))) continue;
      best = place;
      best_cost = cost;
    }
  }
  return best;
}

}  // namespace

std::optional<double> surface_depth(const Strip& strip, const Vector3d& on_face_W, const OccupancyMap& map) {
  // Chosen: shares of half the width.
  constexpr std::array kAcross = {-0.8, -0.4, 0.0, 0.4, 0.8};
  std::vector<double> depths;
  for (const double across : kAcross) {
    const Vector3d from = on_face_W + across * strip.half_width_m * strip.across_W + kOutsideM * strip.out_W;
    const auto hit = map.cast(from, -strip.out_W, kOutsideM + strip.inside_m, kCastRadiusM);
    if (hit) depths.push_back(*hit + 0.5 * kCastRadiusM - kOutsideM);
  }
  if (2 * depths.size() < kAcross.size()) return std::nullopt;
  std::sort(depths.begin(), depths.end());
  return depths[(depths.size() - 1) / 2];
}

std::vector<Run> fit_strip(const Strip& strip, bool reversed, double from_s, const std::optional<Vector3d>& p_W_now,
                           const FreeSpace& space, const CameraReach& reach, const StandoffConfig& config) {
  std::vector<Run> runs;
  std::optional<Place> before;
  if (p_W_now) {
    const Vector3d from_strip = *p_W_now - strip.begin_W;
    before = Place{from_strip.dot(strip.out_W), from_strip.dot(strip.across_W), *p_W_now};
  }
  const double length = strip.length();
  const int steps = std::max(1, static_cast<int>(std::ceil((length - from_s) / config.step_m)));
  for (int i = 0; i <= steps; ++i) {
    const double s = std::min(length, from_s + i * config.step_m);
    const Sample sample = sample_at(strip, reversed, s, space, reach, config);
    const auto place = choose(sample, strip, before ? &*before : nullptr, space, config.step_m);
    if (place) {
      if (!before || runs.empty()) runs.push_back(Run{.waypoints = {}, .first_s = s});
      const double distance = std::max(1.0, place->standoff + sample.depth);
      const double speed = config.speed_gain * reach.blur_speed_mps * distance / reach.sharp_distance_m;
      runs.back().waypoints.push_back({place->p_W, std::clamp(speed, config.min_speed_mps, config.max_speed_mps)});
    }
    before = place;
  }
  // A single waypoint is not worth the flight to it.
  std::erase_if(runs, [](const Run& run) { return run.waypoints.size() < 2; });
  return runs;
}

}  // namespace skein::agent
