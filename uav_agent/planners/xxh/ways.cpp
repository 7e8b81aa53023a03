#include "uav_agent/planners/xxh/ways.hpp"

#include <algorithm>

#include "uav_agent/flight/path_search.hpp"
#include "uav_agent/flight/proof.hpp"
#include "uav_agent/flight/separation.hpp"

namespace skein::agent {
namespace {

constexpr int kFruitlessToBold = 8;
constexpr double kNearM = 20.0;  ///< a way no longer than this may lead through boxes
constexpr double kLongWayM = 10.0;
constexpr double kAroundPeersM = 15.0, kPeerMarginM = 2.5, kLeavesM = 0.05;
constexpr int kFaithfulExpansions = 1000;

}  // namespace

void XxhWays::know_site(const std::vector<OrientedBox>& boxes) {
  site_ = site_of(agent_, boxes, config_.blind_height_ratio);
}

double XxhWays::clearance_m() const { return centre_clearance_m(agent_, config_.clearance_m); }

FreeSpace::Config XxhWays::space() const {
  FreeSpace::Config config;
  config.clearance_m = clearance_m();
  const int rung = std::max(fruitless_ / kFruitlessToBold, dared_);
  config.rays = Proof::of(Proof::rays(site_.roomy), static_cast<std::size_t>(rung), agent_.me().role);
  config.blind_height_m = site_.blind_height_m;
  config.floor_m = std::max(config.floor_m, site_.lowest_m);
  config.hearsay = hearsay_;
  return config;
}

FreeSpace XxhWays::space_for_way(const PlannerInput& in, const Vector3d& goal_W) const {
  FreeSpace::Config config = space();
  const Vector3d here = in.tracking.setpoint.p_WB;
  if ((goal_W - here).norm() > kNearM) config.enter_near_W = {here, goal_W};
  std::vector<Sphere> keep_out = talk_.trajectories(in);
  for (const Peer& peer : reckoned(in.peers, in.tick)) {
    const double wanted = agent_.me().body_radius_m + agent_.fleet[peer.uav].body_radius_m + kPeerMarginM;
    const double distance = (peer.p_W - here).norm();  // whoever is too near already may leave
    if (distance < kAroundPeersM) keep_out.push_back({peer.p_W, std::min(wanted, distance - kLeavesM)});
  }
  return {config, in.boxes, in.map, std::move(keep_out)};
}

std::optional<std::vector<Vector3d>> XxhWays::find(const PlannerInput& in, const Vector3d& goal_W) const {
  const int expansions = config_.faithful ? std::min(config_.expansions, kFaithfulExpansions) : config_.expansions;
  return find_path(space_for_way(in, goal_W), in.boxes, in.tracking.setpoint.p_WB, goal_W,
                   {.max_expansions = expansions});
}

bool XxhWays::fly_to(const Vector3d& goal_W, double slow_mps, const PlannerInput& in, PlannerOutput& out) {
  return fly_along({goal_W}, slow_mps, in, out);
}

bool XxhWays::fly_along(const std::vector<Vector3d>& places_W, double slow_mps, const PlannerInput& in,
                        PlannerOutput& out) {
  auto corners = find(in, places_W.front());
  if (!corners) {
    ++fruitless_;
    pilot_.no_way(places_W.front(), space_for_way(in, places_W.front()), out);
    return false;
  }
  fruitless_ = 0;
  Path path;
  Vector3d at = in.tracking.setpoint.p_WB;
  double speed = path_length(at, *corners) > kLongWayM ? std::max(slow_mps, config_.transit_mps) : slow_mps;
  const auto add = [&](const Vector3d& corner) {
    path.waypoints.push_back({corner, speed});
    at = corner;
  };
  std::ranges::for_each(*corners, add);
  speed = slow_mps;
  const FreeSpace space = space_for_way(in, places_W.front());
  for (std::size_t i = 1; i < places_W.size() && space.segment_free(at, places_W[i]); ++i) {
    add(places_W[i]);
    corners->push_back(places_W[i]);
  }
  corners_ = std::move(*corners);
  pilot_.follow(std::move(path), in, out);
  return true;
}

std::vector<Vector3d> XxhWays::ahead(const PlannerInput& in) const {
  std::vector<Vector3d> ahead = {in.tracking.setpoint.p_WB};
  for (std::size_t i = in.tracking.leg; i < corners_.size() && ahead.size() < XxhWord::kMaxWay; ++i) {
    ahead.push_back(corners_[i]);
  }
  return ahead;
}

}  // namespace skein::agent
