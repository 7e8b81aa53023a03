#include "uav_agent/planners/star/teams.hpp"

#include <algorithm>
#include <tuple>

namespace skein::agent {

std::vector<StarTeam> star_teams(const std::vector<FleetMember>& fleet) {
  std::vector<StarTeam> teams;
  for (std::size_t i = 0; i < fleet.size(); ++i) {
    if (fleet[i].role == Role::explorer) teams.push_back({{i}, {}});
  }
  if (teams.empty()) {
    for (std::size_t i = 0; i < fleet.size(); ++i) teams.push_back({{i}, {}});
    return teams;
  }
  const std::size_t photographers = fleet.size() - teams.size();
  const std::size_t room = (photographers + teams.size() - 1) / teams.size();
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;  // distance, photographer, team
  for (std::size_t i = 0; i < fleet.size(); ++i) {
    if (fleet[i].role == Role::explorer) continue;
    for (std::size_t team = 0; team < teams.size(); ++team) {
      pairs.emplace_back((fleet[i].p_WB_start - fleet[teams[team].uavs[0]].p_WB_start).norm(), i, team);
    }
  }
  std::ranges::sort(pairs);
  std::vector<bool> placed(fleet.size(), false);
  for (const auto& [distance, uav, team] : pairs) {
    if (placed[uav] || teams[team].uavs.size() > room) continue;
    teams[team].uavs.push_back(uav);
    placed[uav] = true;
  }
  return teams;
}

void share_boxes(const std::vector<FleetMember>& fleet, const std::vector<OrientedBox>& boxes, const StarShare& share,
                 std::vector<StarTeam>& teams) {
  FleetTourProblem problem;
  problem.agents = teams.size();
  const std::size_t n = teams.size() + boxes.size();
  problem.costs = CostMatrix(n);
  const auto place = [&](std::size_t node) {
    return node < teams.size() ? fleet[teams[node].uavs[0]].p_WB_start : boxes[node - teams.size()].center;
  };
  for (std::size_t from = 0; from < n; ++from) {
    for (std::size_t to = teams.size(); to < n; ++to) problem.costs(from, to) = (place(to) - place(from)).norm();
  }
  for (const OrientedBox& box : boxes) problem.service.push_back(share.volume_weight * box.size.prod());
  const FleetTours tours = solve_fleet_tours(problem, {.objective = share.objective});
  for (std::size_t team = 0; team < teams.size(); ++team) {
    teams[team].boxes.clear();
    for (const std::size_t node : tours.tours[team]) teams[team].boxes.push_back(node - teams.size());
  }
}

StarTeam own_team(const std::vector<FleetMember>& fleet, std::size_t self, const std::vector<OrientedBox>& boxes,
                  const StarShare& share, bool helps) {
  std::vector<StarTeam> teams = star_teams(fleet);
  share_boxes(fleet, boxes, share, teams);
  StarTeam own =
      *std::ranges::find_if(teams, [self](const StarTeam& team) { return std::ranges::count(team.uavs, self) > 0; });
  if (!own.boxes.empty() || !helps) return own;
  for (std::size_t box = 0; box < boxes.size(); ++box) own.boxes.push_back(box);
  return own;
}

}  // namespace skein::agent
