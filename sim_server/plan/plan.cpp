#include "sim_server/plan/plan.hpp"

#include <algorithm>

#include "oracle/open_space.hpp"
#include "sim_server/plan/legs.hpp"
#include "sim_server/plan/routes.hpp"
#include "sim_server/plan/schedule.hpp"

namespace skein::sim {
namespace {

/// Part of the mission's time that the routes leave free for waits and for the delivery by radio.
constexpr double kReserveShare = 0.01;
constexpr double kReserveS = 1.5;

PlanUav uav_of(const std::string& name, Timetable table) {
  PlanUav uav{name, std::move(table.moves), table.time_s, 0.0, table.views.size()};
  for (const PlanMove& move : uav.moves) uav.distance_m += (move.to_W - move.from_W).norm();
  return uav;
}

}  // namespace

Plan make_plan(const Scenario& scenario, const Scene& scene, const PlanConfig& config) {
  const Team team(scenario, config);
  const std::vector<View> views = make_views(scenario, scene, team, config);
  const RayScene world(scene.mesh);
  Legs legs(scenario, world, box_around(scene.mesh), team, views, config);
  Plan plan;
  plan.margin_m = config.margin_m;
  std::vector<Route> routes(scenario.fleet.size());
  if (!views.empty()) {
    const double time_s = scenario.duration_s * (1.0 - kReserveShare) - kReserveS;
    routes = RouteSearch(legs, scenario, team, views, scene.points.size(), time_s).search(config);
  }
  Schedule schedule(legs, scenario, team, views, config.settle_s, scenario.duration_s);
  std::vector<float> best(scene.points.size(), 0.0F);
  for (const UavIndex uav : scenario.uavs()) {
    Timetable table = schedule.add(routes[static_cast<std::size_t>(uav)]);
    for (const std::size_t view : table.views) {
      for (const Sight& sight : views[view].sights) best[sight.point] = std::max(best[sight.point], sight.q);
    }
    plan.uavs.push_back(uav_of(scenario.fleet[uav].name, std::move(table)));
    plan.views += plan.uavs.back().views;
  }
  for (const float q : best) {
    plan.score += q;
    plan.points += q > 0.0F ? 1 : 0;
  }
  return plan;
}

}  // namespace skein::sim
