#include "sim_server/points_shown.hpp"

#include <algorithm>

#include "sim_server/simulation.hpp"

namespace skein::sim {
namespace {

/// Raises `best` to `more`, point by point. @param more  empty: all 0.
void raise(std::vector<float>& best, const std::vector<float>& more) {
  if (best.size() < more.size()) best.resize(more.size(), 0.0F);
  for (std::size_t i = 0; i < more.size(); ++i) best[i] = std::max(best[i], more[i]);
}

}  // namespace

PointsShown points_shown(const Simulation& simulation) {
  PointsShown shown{.seen = std::vector<bool>(simulation.scene().points.size(), false), .if_exact = {}, .if_calm = {}};
  for (const UavIndex uav : FirstUavs(simulation.size())) {
    const Camera& camera = simulation.camera(uav);
    for (std::size_t i = 0; i < shown.seen.size(); ++i) shown.seen[i] = shown.seen[i] || camera.seen()[i];
    raise(shown.if_exact, camera.best_if_exact());
    raise(shown.if_calm, camera.best_if_calm());
  }
  return shown;
}

}  // namespace skein::sim
