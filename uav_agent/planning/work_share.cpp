#include "uav_agent/planning/work_share.hpp"

#include <algorithm>
#include <utility>

namespace skein::agent {
namespace {

/// Time to fly the parts of a strip that can be flown if only the boxes are obstacles.
double work_seconds(const Strip& strip, const FreeSpace& by_boxes, const CameraReach& reach,
                    const StandoffConfig& standoff) {
  double length = 0.0;
  for (const Run& run : fit_strip(strip, false, 0.0, {}, by_boxes, reach, standoff)) {
    length += static_cast<double>(run.waypoints.size() - 1) * standoff.step_m;
  }
  return length / (standoff.ratio * reach.blur_speed_mps * standoff.speed_gain);
}

struct AllStrips {
  std::vector<Strip> strips;
  std::vector<double> work_s;  ///< time for each strip
};

/// The strips of which at least a part can be flown if only the boxes are obstacles.
AllStrips all_strips(const std::vector<OrientedBox>& boxes, const CameraReach& reach, const WorkShareConfig& config) {
  const OccupancyMap nothing;
  const FreeSpace by_boxes({.use_map = false}, boxes, nothing);
  AllStrips all;
  for (const Strip& strip : cut_into_strips(boxes, reach, config.strips)) {
    const double work_s = work_seconds(strip, by_boxes, reach, config.standoff);
    if (work_s <= 0.0) continue;
    all.strips.push_back(strip);
    all.work_s.push_back(work_s);
  }
  return all;
}

/// Teams: each explorer and the photographers that start near it, as equal in size as possible. If the fleet does not
/// have both roles, each UAV is a team.
std::vector<std::vector<UavIndex>> teams_of(const std::vector<FleetMember>& fleet) {
  const auto has = [&](Role role) {
    return std::ranges::any_of(fleet, [&](const FleetMember& member) { return member.role == role; });
  };
  const bool mixed = has(Role::explorer) && has(Role::photographer);
  std::vector<std::vector<UavIndex>> teams;
  std::vector<UavIndex> others;
  for (const UavIndex i : FirstUavs(fleet.size())) {
    if (mixed && fleet[i].role == Role::photographer) {
      others.push_back(i);
    } else {
      teams.push_back({i});
    }
  }
  for (const UavIndex i : others) {
    const auto rank = [&](const std::vector<UavIndex>& team) {
      return std::pair(team.size(), (fleet[team.front()].p_WB_start - fleet[i].p_WB_start).norm());
    };
    std::ranges::min_element(teams, {}, rank)->push_back(i);
  }
  return teams;
}

}  // namespace

WorkShare team_share(const AgentConfig& agent, const std::vector<OrientedBox>& boxes, const CameraReach& reach,
                     double middle_height_m, const WorkShareConfig& config) {
  AllStrips all = all_strips(boxes, reach, config);
  const std::vector<std::vector<UavIndex>> teams = teams_of(agent.fleet);
  std::vector<Vector3d> starts;
  std::vector<double> team_size;
  std::size_t own = 0, rank = 0;
  for (std::size_t i = 0; i < teams.size(); ++i) {
    const Vector3d start = agent.fleet[teams[i].front()].p_WB_start;
    starts.emplace_back(start.x(), start.y(), middle_height_m);
    team_size.push_back(static_cast<double>(teams[i].size()));
    const auto me = std::ranges::find(teams[i], agent.self);
    if (me == teams[i].end()) continue;
    own = i;
    rank = static_cast<std::size_t>(me - teams[i].begin());
  }
  const std::vector<Visit> tour = share_strips(all.strips, all.work_s, starts, config.transit_mps, team_size)[own];
  WorkShare share{.strips = std::move(all.strips), .tour = {}};
  // In a team of n UAVs, the explorer, which is the first, gets the second of each n strips: of three, the middle one.
  const std::size_t size = teams[own].size();
  for (std::size_t i = 0; i < tour.size(); ++i) {
    if ((i + size - 1) % size == rank) share.tour.push_back(tour[i]);
  }
  return share;
}

}  // namespace skein::agent
