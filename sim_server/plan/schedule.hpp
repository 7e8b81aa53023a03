// Timetables of the UAVs of a plan: their moves one after the other, with waits where two UAVs would come too near.
// Frame: W.   Units: SI.
#pragma once

#include <optional>
#include <vector>

#include "sim_server/plan/legs.hpp"
#include "sim_server/plan/plan.hpp"
#include "sim_server/plan/routes.hpp"

namespace skein::sim {

/// Planned state of a UAV.
struct PlanState {
  Vector3d p_WB = Vector3d::Zero(), v_WB = Vector3d::Zero(), a_WB = Vector3d::Zero();
  double yaw = 0.0, pitch = 0.0;
};
/// @param moves  not empty. Before the first move the UAV is at that move's beginning, after the last at its end. Pure.
PlanState plan_state(const TeamKind& kind, const std::vector<PlanMove>& moves, double t);

/// A UAV's moves, and the views that they include.
struct Timetable {
  std::vector<PlanMove> moves;
  std::vector<std::size_t> views;
  double time_s = 0.0;  ///< when the last picture has been delivered
};

/// Deconflicts the routes by priority: earlier UAVs of the fleet have the right of way. Later ones wait, or skip a view
/// if waiting does not help.
/// Not thread-safe.
class Schedule {
 public:
  /// All must outlive this.  @param settle_s  rest before a picture.  @param end_s  deadline for deliveries.
  Schedule(Legs& legs, const Scenario& scenario, const Team& team, const std::vector<View>& views, double settle_s,
           double end_s);

  /// Adds the next UAV of the fleet.
  Timetable add(const Route& route);

  /// Least permitted distance between the centres of two bodies [m].
  static double least_distance(const TeamKind& a, const TeamKind& b);

 private:
  struct Trip;
  const TeamKind& kind_of(std::size_t uav) const { return team_.kinds[team_.kind_of[uav]]; }
  PlanMove takeoff(std::size_t uav) const;
  bool apart(std::size_t uav, const std::vector<PlanMove>& moves, double from_s, double until_s) const;
  Trip trip(const Trip& before, std::size_t from, std::size_t to);
  bool leave(std::size_t uav, Trip& trip, double stay_s) const;
  std::optional<std::vector<PlanMove>> home(std::size_t uav, const Trip& last, std::size_t view);

  Legs& legs_;
  const Scenario& scenario_;
  const Team& team_;
  const std::vector<View>& views_;
  double settle_s_, end_s_;
  std::vector<std::vector<PlanMove>> earlier_;  ///< moves of the UAVs that were added
  std::vector<Vector3d> grounds_;               ///< by UAV: its place on the ground before its first move
};

}  // namespace skein::sim
