#include <algorithm>
#include <cmath>

#include "core/math/euler.hpp"
#include "core/scoring/score_table.hpp"
#include "sim_server/plan/plan.hpp"
#include "sim_server/plan/schedule.hpp"
#include "sim_server/simulation.hpp"

namespace skein::sim {
namespace {

/// The simulation goes on for this long after the mission's time, because the clock starts after the first command.
constexpr double kFlownLonger_s = 5.0;
/// Exchanges for which a link must last until a report counts as delivered: report, judgement, and acknowledgement.
constexpr int kLinkedSteps = 4;
constexpr double kBodyTurn = 30.0 * kRadPerDeg;  ///< yaw rate of the body; the gimbal turns in addition [rad/s]

/// Models the delivery of capture reports to the station.
class Uplinks {
 public:
  Uplinks(const Scenario& scenario, std::size_t points)
      : table_(scenario.fleet.size(), points, scenario.rules),
        waiting_(scenario.fleet.size()),
        linked_steps_(scenario.fleet.size(), 0) {}

  void step(const Simulation& sim) {
    for (const CaptureEvent& event : sim.events().captures) {
      if (event.report) waiting_[event.uav].push_back(*event.report);
    }
    for (const Collision& collision : sim.events().collisions) {
      ++collisions_;
      table_.collide(collision.uav);
    }
    for (const UavIndex uav : FirstUavs(sim.size())) {
      const bool linked = sim.open_links().at(node_of_uav(uav), kStationNode) != 0;
      linked_steps_[uav] = linked ? linked_steps_[uav] + 1 : 0;
      if (linked_steps_[uav] < kLinkedSteps) continue;
      for (const CaptureReport& report : waiting_[uav]) table_.add(report);
      waiting_[uav].clear();
    }
  }

  PlanFlight result(double astray_m) const { return {table_.score(), table_.points_detected(), collisions_, astray_m}; }

 private:
  ScoreTable table_;
  std::vector<std::vector<CaptureReport>> waiting_;
  std::vector<int> linked_steps_;
  std::size_t collisions_ = 0;
};

/// Commands one UAV along its moves. The gimbal compensates for the yaw that the body still lacks, so that the camera
/// has the planned heading.
class Pilot {
 public:
  explicit Pilot(double start_yaw) : yaw_(start_yaw) {}

  void command(Simulation& sim, UavIndex uav, const PlanState& state, double step_s) {
    const double most = kBodyTurn * step_s;
    yaw_ = wrap_angle(yaw_ + std::clamp(wrap_angle(state.yaw - yaw_), -most, most));
    const RigidBodyState& now = sim.uav(uav).state;
    if (sim.uav(uav).alive) astray_m_ = std::max(astray_m_, (now.p_WB - state.p_WB).norm());
    sim.command_trajectory(uav, {state.p_WB, state.v_WB, state.a_WB, yaw_, 0.0});
    const double body_yaw = roll_pitch_yaw(now.q_WB.toRotationMatrix()).yaw;
    sim.command_gimbal(uav, {GimbalMode::angle, state.pitch, wrap_angle(state.yaw - body_yaw)});
  }
  double astray_m() const { return astray_m_; }

 private:
  double yaw_, astray_m_ = 0.0;
};

}  // namespace

PlanFlight fly_plan(const Scenario& of_scenario, const Scene& scene, const PlanConfig& config, const Plan& plan) {
  Scenario scenario = of_scenario;
  scenario.conditions = {};  // estimates are those of an ideal world (docs/conditions.md)
  const Team team(scenario, config);
  Simulation sim(scenario, scene, 0);
  std::vector<Pilot> pilots;
  for (const UavIndex uav : scenario.uavs()) {
    sim.want_scans(uav, false);
    pilots.emplace_back(scenario.fleet[uav].start_yaw);
  }
  Uplinks uplinks(scenario, scene.points.size());
  while (sim.mission().end() == MissionEnd::none && seconds(sim.tick()) < scenario.duration_s + kFlownLonger_s) {
    const double t = seconds(sim.tick());
    for (const UavIndex uav : scenario.uavs()) {
      const std::vector<PlanMove>& moves = plan.uavs[uav].moves;
      if (moves.empty() || t < moves.front().from_s - kSpinUpS) continue;
      const PlanState state = plan_state(team.kinds[team.kind_of[uav]], moves, t);
      pilots[uav].command(sim, uav, state, scenario.exchange_period_s);
    }
    sim.advance();
    uplinks.step(sim);
  }
  double astray_m = 0.0;
  for (const Pilot& pilot : pilots) astray_m = std::max(astray_m, pilot.astray_m());
  return uplinks.result(astray_m);
}

}  // namespace skein::sim
