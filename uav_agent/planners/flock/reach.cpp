#include "uav_agent/planners/flock/reach.hpp"

#include <algorithm>

#include "uav_agent/flight/voxel_route.hpp"
#include "uav_agent/flight_core/flight_config.hpp"

namespace skein::agent {
namespace {

constexpr double kRefusedS = 15.0;   ///< time for which a UAV leaves out a view that it could not reach, ...; chosen
constexpr double kRefusedM = 2.0;    ///< ... and views this near to it; chosen
constexpr double kShutOffS = 5.0;    ///< the same for views to which no free cubes of the map lead; chosen
constexpr double kApartM = 4.5;      ///< least distance of a view to other UAVs, and to their next views; chosen
constexpr double kStallS = 2.5;      ///< a UAV that moves no farther than kStaysM in this time is held up (chosen) ...
constexpr double kStalledS = 6.0;    ///< ... and leaves its view out for this time; chosen
constexpr double kInTheWayM = 9.0;   ///< the nearest UAV within this holds this one up, and is avoided; chosen
constexpr double kAwayCosine = 0.2;  ///< a view is in the direction of a UAV if the cosine is greater; chosen

}  // namespace

void FlockReach::refuse(const Vector3d& p_WB, Tick now) { refused_.push_back({p_WB, now + ticks(kRefusedS)}); }

void FlockReach::refuse_shut_off(const std::vector<FlockView>& views, const VoxelGrid& grid, const PlannerInput& in) {
  const Vector3d here_W = in.tracking.setpoint.p_WB;
  const auto reached = voxels_in_reach(grid, *in.space, here_W);
  if (!reached) return;
  for (const FlockView& view : views) {
    bool leads_there = false;
    if (const auto cube = grid.at(view.p_WB)) {
      grid.around(*cube, 1, [&](VoxelGrid::Id id) { leads_there |= (*reached)[id]; });
    }
    if (leads_there || in.space->segment_free(here_W, view.p_WB)) continue;
    refused_.push_back({view.p_WB, in.tick + ticks(kShutOffS)});
  }
}

void FlockReach::update(Tick now) {
  std::erase_if(refused_, [&](const Refused& refused) { return refused.until <= now; });
}

bool FlockReach::out_of_reach(const Vector3d& p_WB, const PlannerInput& in) const {
  const auto near = [&](const Vector3d& p_W, double m) { return (p_W - p_WB).squaredNorm() < m * m; };
  const auto is_near = [&](const Refused& refused) { return near(refused.p_W, kRefusedM); };
  return std::ranges::any_of(refused_, is_near) || taken(p_WB, in);
}

bool FlockReach::taken(const Vector3d& p_WB, const PlannerInput& in) const {
  const auto near = [&](const Vector3d& p_W, double m) { return (p_W - p_WB).squaredNorm() < m * m; };
  for (const Peer& peer : in.peers.all()) {
    if (!peer.visible) continue;
    if (near(peer.p_W, kApartM)) return true;
    // This UAV avoids the direction of one that held it up. Otherwise the two could block each other for ever.
    const bool gives_way = in_the_way_ == std::size_t{peer.uav} && in.tick < gives_way_until_;
    const Vector3d way = p_WB - in.tracking.setpoint.p_WB, to_peer = peer.p_W - in.tracking.setpoint.p_WB;
    if (gives_way && way.dot(to_peer) > kAwayCosine * way.norm() * to_peer.norm()) return true;
  }
  for (const auto& [uav, claims] : talk_.claims(in.tick)) {
    if (uav < agent_.self && !claims.empty() && near(claims.front().p_WB, kApartM)) return true;
  }
  return false;
}

std::vector<Vector3d> FlockReach::not_taken(const std::vector<FlockView>& views, std::size_t most,
                                            const PlannerInput& in) const {
  std::vector<Vector3d> places_W;
  for (const FlockView& view : views) {
    if (places_W.size() < most && !taken(view.p_WB, in)) places_W.push_back(view.p_WB);
  }
  return places_W;
}

std::optional<FlockView> FlockReach::first(const std::vector<FlockView>& views, const PlannerInput& in) const {
  const auto in_reach = [&](const FlockView& view) { return !out_of_reach(view.p_WB, in); };
  const auto found = std::ranges::find_if(views, in_reach);
  return found == views.end() ? std::nullopt : std::optional(*found);
}

bool FlockReach::stalls(const PlannerInput& in, const std::optional<Vector3d>& to_W) {
  if (!to_W || (in.state.p_WB - gained_p_W_).norm() > kStaysM) {
    gained_p_W_ = in.state.p_WB;
    gained_at_ = in.tick;
  }
  if (!to_W || seconds(in.tick - gained_at_) < kStallS) return false;
  gained_at_ = in.tick;
  refused_.push_back({*to_W, in.tick + ticks(kStalledS)});
  double nearest_m = kInTheWayM;
  for (const Peer& peer : in.peers.all()) {
    const double off_m = (peer.p_W - in.state.p_WB).norm();
    if (!peer.visible || off_m >= nearest_m) continue;
    nearest_m = off_m;
    in_the_way_ = peer.uav;
    gives_way_until_ = in.tick + ticks(kStalledS);
  }
  return true;
}

}  // namespace skein::agent
