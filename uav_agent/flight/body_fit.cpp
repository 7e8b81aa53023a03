#include "uav_agent/flight/body_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skein::agent {
namespace {

/// Lifetimes of an answer in the cache: of Fits::everywhere, and of any other. Chosen.
constexpr double kFreeForS = 4.0, kUnknownForS = 1.0;
constexpr std::size_t kMostAnswers = 200'000;        ///< memory: with more answers, the cache is emptied
constexpr std::uint32_t kTimeBits = (1U << 30) - 1;  ///< memory: of an answer's time

}  // namespace

void BodyFit::update(const WorldMap& map, Tick now) {
  map_ = &map;
  now_ = now;
  if (asked_ > kMostAnswers) forget();
}

void BodyFit::set(double radius_m, double ground_m) {
  if (radius_m == radius_m_ && ground_m == ground_m_) return;
  radius_m_ = radius_m;
  ground_m_ = ground_m;
  forget();
}

void BodyFit::forget() {
  answers_.clear();
  asked_ = 0;
}

double BodyFit::age_s(const Answer& answer) const {
  return seconds(Tick{(static_cast<std::uint32_t>(now_) - answer.at) & kTimeBits});
}

BodyFit::Answer& BodyFit::answer_of(const WorldMap::Cube& cube) const {
  const auto in = [&](int axis) { return static_cast<std::size_t>(cube[axis] & (kBlock - 1)); };
  return answers_[grid_key(shifted(cube, kBlockBits))][in(0) | in(1) << kBlockBits | in(2) << 2 * kBlockBits];
}

bool BodyFit::fits(const Vector3d& p_W) const {
  const WorldMap::Cube cube = map_->cube_of(p_W);
  Answer& answer = answer_of(cube);
  const bool is_new = answer.fits == Fits::unasked;
  if (is_new) ++asked_;
  if (is_new || age_s(answer) >= (answer.fits == Fits::everywhere ? kFreeForS : kUnknownForS)) {
    answer.at = static_cast<std::uint32_t>(now_) & kTimeBits;
    answer.fits = fits_in(cube);
  }
  if (answer.fits == Fits::somewhere) return map_->ball_free(p_W, radius_m_, ground_m_);
  return answer.fits == Fits::everywhere;
}

/// Two checks at the middle of a cube bound the answer for all places in it. First the one that fails in unknown space.
BodyFit::Fits BodyFit::fits_in(const WorldMap::Cube& cube) const {
  const double to_corner_m = 0.5 * std::numbers::sqrt3 * map_->config().cell_m;
  const Vector3d middle_W = map_->middle_W(cube);
  if (!map_->ball_free(middle_W, std::max(0.0, radius_m_ - to_corner_m), ground_m_)) return Fits::nowhere;
  return map_->ball_free(middle_W, radius_m_ + to_corner_m, ground_m_) ? Fits::everywhere : Fits::somewhere;
}

}  // namespace skein::agent
