#include "uav_agent/planners/xxh/post.hpp"

#include <algorithm>

namespace skein::agent {
namespace {

constexpr double kPostsApartM = 4.0;  ///< between the posts of those who wait
constexpr int kHeights = 8;

}  // namespace

void XxhPost::leave_for_good() {
  taken_ = false;
  choice_ = 0;
}

/// Beside the entry, each at a distance of its own; where something is in the way, higher.
std::vector<Vector3d> XxhPost::places(const Vector3d& entry_W, const Vector3d& centre_W, std::size_t rank) const {
  Vector3d out = entry_W - centre_W;
  out.z() = 0.0;
  if (out.norm() < 1.0) out = Vector3d::UnitX();
  const Vector3d place = entry_W + kPostsApartM * static_cast<double>(rank + 1) * out.normalized();
  const double lowest = std::max(place.z(), ways_.site().safe_height_m() + kPostsApartM);
  const double highest = std::max(lowest, ways_.site().top_m + kPostsApartM * static_cast<double>(agent_.self + 2));
  std::vector<Vector3d> places;
  for (int i = 0; i < kHeights; ++i) {
    places.emplace_back(place.x(), place.y(), lowest + (highest - lowest) * i / (kHeights - 1));
  }
  return places;
}

bool XxhPost::take_beside(const Vector3d& entry_W, const Vector3d& centre_W, std::size_t rank, const PlannerInput& in,
                          PlannerOutput& out) {
  const auto choices = places(entry_W, centre_W, rank);
  taken_ = ways_.fly_to(choices[choice_], config_.transit_mps, in, out);
  if (!taken_) choice_ = (choice_ + 1) % choices.size();
  return taken_;
}

bool XxhPost::take_at_home(const PlannerInput& in, PlannerOutput& out) {
  Vector3d home = agent_.me().p_WB_start;
  home.z() = ways_.site().safe_height_m() + kPostsApartM * static_cast<double>(agent_.self + 1);
  taken_ = ways_.fly_to(home, config_.transit_mps, in, out);
  return taken_;
}

}  // namespace skein::agent
