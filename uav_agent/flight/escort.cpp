#include "uav_agent/flight/escort.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <tuple>
#include <utility>

namespace skein::agent {
namespace {

constexpr double kRisenM = 2.5;   ///< above the start
constexpr double kAfterS = 20.0;  ///< in the air: most have risen by then, and are in sight
constexpr double kStayS = 11.0;   ///< there: time to be seen, to look, and to rise
constexpr double kLowM = 12.0;    ///< above the start: whoever is higher looks for a way down first,
constexpr double kLookS = 4.0, kDownM[] = {9.0, 5.0};  ///< so long, and as far as it sees empty space
constexpr double kCloserM = 4.0;
constexpr double kAgainS = 15.0;
constexpr int kMostAttempts = 4;
constexpr double kShareOfMission = 0.3;  ///< for all trips together
constexpr double kShareOfRest = 0.5;     ///< of the mission, beyond which the way there is not worth it
constexpr double kAsideM = 7.0;          ///< the one below climbs straight up, and a crown above it hides it from there
constexpr double kAboveM[] = {10.5, 13.5, 17.5, 24.0, 32.0};  ///< the first: empty space is seen down to the ground
constexpr int kSides = 8;
constexpr double kSightM = 0.3, kStandsM = 1.0;
constexpr double kNotAgainM = 4.0;  ///< to where it has set out before

/// From where a LiDAR sees what is above a start: the first that is free and in view of it, else the first free.
/// @param tried_W  not there again.
std::optional<Vector3d> place_beside(const Vector3d& start_W, const Vector3d& here_W,
                                     const std::vector<Vector3d>& tried_W, const FreeSpace& space) {
  const Vector3d way = here_W - start_W;
  const double heading = std::atan2(way.y(), way.x());
  std::optional<Vector3d> free;
  std::vector<double> heights(std::begin(kAboveM), std::end(kAboveM));
  for (const double down : kDownM) heights.push_back(std::max(kAboveM[0], way.z() - down));
  heights.push_back(std::max(kAboveM[0], way.z()));  // where it flies, if nothing lower was seen to be free
  for (const double above : heights) {
    for (int i = 0; i < kSides; ++i) {
      const int turn = i % 2 == 0 ? i / 2 : -(i + 1) / 2;
      const double a = heading + 2.0 * std::numbers::pi * turn / kSides;
      const Vector3d p_W = start_W + Vector3d(kAsideM * std::cos(a), kAsideM * std::sin(a), above);
      const auto near = [&](const Vector3d& q_W) { return (p_W - q_W).norm() < kNotAgainM; };
      if (std::ranges::any_of(tried_W, near) || !space.free(p_W)) continue;
      if (space.sees(p_W, start_W + Vector3d(0.0, 0.0, kStandsM), kSightM)) return p_W;
      if (!free) free = p_W;
    }
  }
  return free;
}

}  // namespace

void Escort::take_charge() {
  if (agent_.me().role != Role::explorer) return;
  for (std::size_t i = 0; i < agent_.fleet.size(); ++i) {
    if (agent_.fleet[i].role == Role::explorer) continue;
    std::size_t nearest = agent_.self;
    const auto off_m = [&](std::size_t j) { return (agent_.fleet[j].p_WB_start - agent_.fleet[i].p_WB_start).norm(); };
    for (std::size_t j = 0; j < agent_.fleet.size(); ++j) {
      const bool sees = agent_.fleet[j].role == Role::explorer;
      if (sees && (off_m(j) < off_m(nearest) || (off_m(j) == off_m(nearest) && j < nearest))) nearest = j;
    }
    if (nearest == agent_.self && off_m(nearest) > kBesideM) charges_.push_back({i});
  }
}

void Escort::update(const PlannerInput& in) {
  if (!in_air_since_) {
    in_air_since_ = in.tick;
    take_charge();
  }
  for (const Peer& peer : in.peers.all()) {
    if (!peer.seen || peer.p_W.z() < agent_.fleet[peer.uav].p_WB_start.z() + kRisenM) continue;
    std::erase_if(charges_, [&](const Charge& charge) { return peer.uav == charge.uav; });
  }
}

Escort::Charge& Escort::next_charge(const Vector3d& here_W) {
  return *std::ranges::min_element(charges_, {}, [&](const Charge& c) {
    return std::tuple(!(goes_on_ && c.uav == fetched_), c.attempts, (start_W(c) - here_W).norm());
  });
}

bool Escort::begin(const PlannerInput& in, const FreeSpace::Config& space, Pilot& pilot, PlannerOutput& out) {
  if (charges_.empty() || in.tick < next_try_ || seconds(in.tick - *in_air_since_) < kAfterS) return false;
  const Vector3d here_W = in.tracking.setpoint.p_WB;
  Charge& charge = next_charge(here_W);
  fetched_ = charge.uav;
  there_since_.reset();
  next_try_ = in.tick + ticks(kAgainS);
  const double way_s = (start_W(charge) - here_W).norm() / agent_.vehicle.max_speed_mps;
  const bool worth_it = in.mission_remaining_s && way_s < kShareOfRest * *in.mission_remaining_s &&
                        seconds(spent_) < kShareOfMission * (seconds(in.tick) + *in.mission_remaining_s);
  set_out_ = in.tick;
  if (worth_it && sets_out(charge, in, space, pilot, out)) return true;
  give_up(in);
  return false;
}

/// To where it sees what is above the one that it fetches, or nearer to there.
bool Escort::sets_out(Charge& charge, const PlannerInput& in, const FreeSpace::Config& space, Pilot& pilot,
                      PlannerOutput& out) {
  const Vector3d here_W = in.tracking.setpoint.p_WB;
  const auto place_W = place_beside(start_W(charge), here_W, charge.tried_W, FreeSpace(space, in.boxes, in.map));
  stops_short_ = !place_W;
  if (stops_short_) return fly_nearer(charge, in, space, pilot, out);
  charge.tried_W.push_back(*place_W);
  return pilot.fly_to(*place_W, in, space, out).found;
}

/// As far as it is known to be free; what it sees there shows more of the way.
bool Escort::fly_nearer(const Charge& charge, const PlannerInput& in, FreeSpace::Config space, Pilot& pilot,
                        PlannerOutput& out) const {
  space.enter_radius_m = kAnywhereM;
  const Vector3d here_W = in.tracking.setpoint.p_WB;
  Vector3d aside_W = here_W - start_W(charge);
  aside_W.z() = 0.0;
  const Vector3d goal_W = start_W(charge) + kAsideM * aside_W.normalized() + kAboveM[0] * Vector3d::UnitZ();
  return pilot.fly_nearer(goal_W, kCloserM, in, space, out);
}

bool Escort::step(const PlannerInput& in) {
  spent_ += in.tick - std::exchange(set_out_, in.tick);
  const auto charge = std::ranges::find(charges_, *fetched_, &Charge::uav);
  if (charge == charges_.end()) return true;
  if (!in.tracking.done) return false;
  if (!there_since_) there_since_ = in.tick;
  const bool goes_on = stops_short_ || in.state.p_WB.z() > start_W(*charge).z() + kLowM;
  if (seconds(in.tick - *there_since_) < (goes_on ? kLookS : kStayS)) return false;
  if (!goes_on) give_up(in);
  goes_on_ = goes_on;
  next_try_ = in.tick;  // nearer, or lower down, if that was seen to be free from here
  return true;
}

void Escort::give_up(const PlannerInput& in) {
  goes_on_ = false;
  next_try_ = in.tick + ticks(kAgainS);
  std::erase_if(charges_,
                [&](Charge& charge) { return charge.uav == *fetched_ && ++charge.attempts >= kMostAttempts; });
}

}  // namespace skein::agent
