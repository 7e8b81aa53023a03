#include "uav_agent/planners/flock/route.hpp"

#include <algorithm>
#include <cmath>

namespace skein::agent {
namespace {

constexpr std::size_t kMostFirst = 5;            ///< most views tried as the beginning of a route; chosen
constexpr double kDetour = 1.5, kDetourM = 6.0;  ///< a way around structure: factor and metres in addition; chosen
/// Speed through space that is not proved free, and time in addition. Chosen; decision 36 has 1.2 m/s, too.
constexpr double kProveMps = 1.8, kProveS = 3.0;
constexpr double kKeep = 1.2;    ///< factor for routes that begin with the present view; chosen
constexpr double kAgain = 0.3;   ///< share of a second survey view that counts: the first one shows the rest; chosen
constexpr double kLeast = 0.02;  ///< views with less gain are left out [points]; chosen
/// Later views are less certain: after n views, the next one counts 1 / (1 + kDoubt n). Chosen.
constexpr double kDoubt = 0.25;

double gain_of(const FlockView& view, const FlockTargets& targets, const std::vector<float>& have, double prove_gain,
               bool surveyed = false) {
  double gain = 0.0;
  for (const FlockView::Sight& sight : view.sights) {
    const double better = sight.q - have[sight.target];
    if (better > 0.0) gain += targets.all()[sight.target].points * better;
  }
  return gain * (view.proved ? 1.0 : 1.0 + prove_gain) + (surveyed ? kAgain : 1.0) * view.survey;
}

}  // namespace

namespace {

/// @param straight  the view is in line of sight: no detour is needed.
double way_s(const Vector3d& from_W, const Vector3d& direction_W, const FlockView& to, const FlockPace& pace,
             bool straight) {
  double way_m = (to.p_WB - from_W).norm();
  if (!straight) way_m = kDetour * way_m + kDetourM;
  double fly_s =
      way_m < FlockPace::kFarM ? way_m / pace.near_mps : way_m / pace.far_mps + pace.far_mps / pace.acceleration_mps2;
  if (!to.proved) fly_s = std::max(fly_s, way_m / kProveMps + kProveS);
  const Vector3d direction = (to.aim_W - to.p_WB).normalized();
  const double turn_s = std::acos(std::clamp(direction.dot(direction_W), -1.0, 1.0)) / pace.gimbal_radps;
  return std::max(fly_s, turn_s) + pace.stop_s;
}

}  // namespace

double way_s(const VoxelGrid& grid, const Vector3d& from_W, const Vector3d& direction_W, const FlockView& to,
             const FlockPace& pace) {
  return way_s(from_W, direction_W, to, pace, grid.sees(from_W, to.p_WB));
}

FlockRoute find_route(const std::vector<FlockView>& views, const FlockTargets& targets, const VoxelGrid& grid,
                      const Vector3d& p_W, const Vector3d& direction_W, const FlockPace& pace, double prove_gain,
                      int depth, std::optional<std::size_t> current) {
  std::vector<float> before;
  for (const FlockTarget& target : targets.all()) before.push_back(static_cast<float>(target.have));
  std::vector<std::pair<double, std::size_t>> first;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const double gain = gain_of(views[i], targets, before, prove_gain);
    if (gain > kLeast) first.emplace_back(gain / way_s(grid, p_W, direction_W, views[i], pace), i);
  }
  std::ranges::stable_sort(first, std::greater<>(), [](const auto& entry) { return entry.first; });
  const auto is_current = [&](const auto& entry) { return current && entry.second == *current; };
  if (const auto found = std::ranges::find_if(first, is_current); found != first.end()) {
    std::rotate(first.begin(), found, found + 1);
  }
  if (first.size() > kMostFirst) first.resize(kMostFirst);
  FlockRoute best;
  double best_rate = 0.0;
  for (const auto& [rate, begin] : first) {
    FlockRoute route;
    std::vector<float> have = before;
    std::vector<std::uint8_t> used(views.size(), 0);
    Vector3d at_W = p_W, looks_W = direction_W;
    bool surveyed = false;
    std::size_t next = begin;
    for (int step = 0; step < depth; ++step) {
      const FlockView& view = views[next];
      route.views.push_back(next);
      used[next] = 1;
      const double sure = 1.0 / (1.0 + kDoubt * step);
      route.gain += sure * gain_of(view, targets, have, prove_gain, surveyed);
      surveyed |= view.survey > 0.0;
      route.time_s += sure * way_s(grid, at_W, looks_W, view, pace);
      for (const FlockView::Sight& sight : view.sights) have[sight.target] = std::max(have[sight.target], sight.q);
      at_W = view.p_WB;
      looks_W = (view.aim_W - view.p_WB).normalized();
      double most = 0.0;
      for (std::size_t i = 0; i < views.size(); ++i) {
        if (used[i] != 0) continue;
        const double gain = gain_of(views[i], targets, have, prove_gain, surveyed);
        // Most views cannot be the best one even if the way there is straight: no search in the map for those.
        if (gain <= kLeast || gain <= most * way_s(at_W, looks_W, views[i], pace, true)) continue;
        const double per_s = gain / way_s(grid, at_W, looks_W, views[i], pace);
        if (per_s <= most) continue;
        most = per_s;
        next = i;
      }
      if (most <= 0.0) break;
    }
    const double worth = route.rate() * (current && begin == *current ? kKeep : 1.0);
    if (worth <= best_rate) continue;
    best_rate = worth;
    best = std::move(route);
  }
  return best;
}

}  // namespace skein::agent
