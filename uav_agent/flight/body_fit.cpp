#include "uav_agent/flight/body_fit.hpp"

#include <algorithm>
#include <cmath>

#include "uav_agent/maps/block_table.hpp"

namespace skein::agent {
namespace {

constexpr double kFreeForS = 4.0, kUnknownForS = 1.0;  ///< an answer is kept
constexpr std::size_t kMostAnswers = 200'000;

}  // namespace

void BodyFit::update(const WorldMap& map, Tick now) {
  map_ = &map;
  now_ = now;
  if (answers_.size() > kMostAnswers) answers_.clear();
}

bool BodyFit::fits(const Vector3d& p_W) const {
  const WorldMap::Cube cube = map_->cube_of(p_W);
  const auto [it, is_new] = answers_.try_emplace(grid_key(cube));
  Answer& answer = it->second;
  if (is_new || seconds(now_ - answer.at) >= (answer.fits == Fits::everywhere ? kFreeForS : kUnknownForS)) {
    answer = {now_, fits_in(cube)};
  }
  if (answer.fits == Fits::somewhere) return map_->ball_free(p_W, radius_m_, ground_m_);
  return answer.fits == Fits::everywhere;
}

/// By two questions about the middle of a cube.
BodyFit::Fits BodyFit::fits_in(const WorldMap::Cube& cube) const {
  const double to_corner_m = 0.5 * std::sqrt(3.0) * map_->config().cell_m;
  const Vector3d middle_W = map_->middle_W(cube);
  if (map_->ball_free(middle_W, radius_m_ + to_corner_m, ground_m_)) return Fits::everywhere;
  const bool nowhere = !map_->ball_free(middle_W, std::max(0.0, radius_m_ - to_corner_m), ground_m_);
  return nowhere ? Fits::nowhere : Fits::somewhere;
}

}  // namespace skein::agent
