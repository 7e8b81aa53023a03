#include "uav_agent/planners/xxh/post.hpp"

#include <algorithm>

namespace skein::agent {
namespace {

constexpr double kPostsApartM = 4.0;  ///< between the posts of two waiting UAVs; chosen
constexpr int kHeights = 6;           ///< a UAV's posts beside an entry, one above the other; chosen
constexpr double kStaysS = 2.0;       ///< time between two renewals of the goal: without one, a recovery begins; chosen
constexpr double kTriesAgainS = 5.0;  ///< pause without a path: the flight core may begin a recovery behaviour; chosen
constexpr std::size_t kMostPosts = 3;  ///< most posts offered to the flight core at once; chosen
constexpr double kRayM = 0.25;         ///< least distance of a line of sight to mapped cells; chosen

}  // namespace

std::vector<Vector3d> XxhPost::beside(const Vector3d& entry_W, const Vector3d& centre_W, std::size_t rank,
                                      double top_m) const {
  Vector3d out = entry_W - centre_W;
  out.z() = 0.0;
  if (out.norm() < 1.0) out = Vector3d::UnitX();
  const Vector3d place = entry_W + kPostsApartM * static_cast<double>(rank + 1) * out.normalized();
  const double lowest = std::max(place.z(), kPostsApartM);
  const double highest = std::max(lowest, top_m + kPostsApartM * static_cast<double>(agent_.self + 2));
  std::vector<Vector3d> places;
  for (int i = 0; i < kHeights; ++i) {
    places.emplace_back(place.x(), place.y(), lowest + (highest - lowest) * i / (kHeights - 1));
  }
  return places;
}

std::vector<Vector3d> XxhPost::at_home() const {
  const double up = kPostsApartM * static_cast<double>(agent_.self + 1);
  return {agent_.me().p_WB_start + Vector3d(0.0, 0.0, up)};
}

void XxhPost::stay(const std::vector<Vector3d>& places_W, double speed_mps, XxhErrand& errand, const PlannerInput& in,
                   PlannerOutput& out) {
  if (const auto& end = errand.ended(); end && end->reached && to_post_)
    post_W_ = errand.choice(end->choice).way.back().p_WB;
  if (errand.came_to_nothing()) {
    post_W_.reset();
    not_before_ = in.tick + ticks(kTriesAgainS);
  }
  if (errand.under_way() || in.tick < not_before_) return;
  not_before_ = in.tick + ticks(kStaysS);
  std::vector<Goal> choices;
  for (const Vector3d& p_W : places_W) {
    if (!post_W_ && choices.size() < kMostPosts && in.space->free(p_W)) choices.push_back({.way = {{p_W, speed_mps}}});
  }
  to_post_ = post_W_ || !choices.empty();
  if (choices.empty()) choices.push_back({.way = {{post_W_.value_or(in.tracking.setpoint.p_WB), speed_mps}}});
  errand.set_out(std::move(choices), out);
}

void sort_by_sight(const std::vector<Vector3d>& explorer_W, const FreeSpace& space, std::vector<Vector3d>& posts_W) {
  std::vector<std::pair<std::ptrdiff_t, Vector3d>> ranked;
  for (const Vector3d& post : posts_W) {
    const auto seen = std::ranges::count_if(explorer_W, [&](const Vector3d& p) { return space.sees(post, p, kRayM); });
    ranked.emplace_back(seen, post);
  }
  std::ranges::stable_sort(ranked, std::ranges::greater(), &std::pair<std::ptrdiff_t, Vector3d>::first);
  for (std::size_t i = 0; i < ranked.size(); ++i) posts_W[i] = ranked[i].second;
}

}  // namespace skein::agent
