#include "uav_agent/flight/body_fit.hpp"

#include "uav_agent/maps/block_table.hpp"

namespace skein::agent {
namespace {

constexpr double kFreeForS = 4.0, kUnknownForS = 1.0;  ///< an answer is kept
constexpr double kOffMiddleM = 0.2;                    ///< a place is off the middle of its cube, by so much or so
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
  if (!is_new && seconds(now_ - answer.at) < (answer.fits ? kFreeForS : kUnknownForS)) return answer.fits;
  const Vector3d middle_W = (cube.cast<double>() + Vector3d::Constant(0.5)) * map_->config().cell_m;
  const double radius_m = radius_m_ + kOffMiddleM;
  answer.at = now_;
  answer.fits = map_->ball_free(middle_W, radius_m, ground_m_);
  return answer.fits;
}

}  // namespace skein::agent
