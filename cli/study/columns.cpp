#include "cli/study/columns.hpp"

#include <algorithm>
#include <stdexcept>

namespace skein::cli {

const std::vector<StudyColumn>& study_columns() {
  using F = FlightFigures;
  static const std::vector<StudyColumn> kColumns = {
      {"score", "Score", "sum over all points of the best delivered capture, of UAVs without a collision", 1, true,
       [](const F& f) { return f.score; }},
      {"attainable_percent", "% of attainable", "of what full knowledge of the scene could score", 1, true,
       [](const F& f) { return f.attainable_percent; }},
      {"points_detected", "Points detected", "points with a delivered capture of quality 0.2 or better", 0, true,
       [](const F& f) { return f.points_detected; }},
      {"mean_quality", "Mean quality", "score by detected point", 3, true, [](const F& f) { return f.mean_quality; },
       true},
      {"greatest_share", "Greatest share [%]", "of one UAV in the score", 0, true,
       [](const F& f) { return f.greatest_share; }, true},
      {"collisions", "Collisions", "with the structure, the ground or another UAV", 0, true,
       [](const F& f) { return f.collisions; }},
      {"frozen_uavs", "Frozen UAVs", "did almost no work for a minute although there was work for them", 0, true,
       [](const F& f) { return f.frozen_uavs; }},
      {"frozen_s", "Idle [s]", "time without work although there was some, without excused waiting; of the whole fleet",
       0, true, [](const F& f) { return f.frozen_s; }, true},
      {"without_work_s", "Longest idle [s]", "longest time of one UAV with almost no work although there was some", 0,
       true, [](const F& f) { return f.without_work_s; }},
      {"waiting_uavs", "Waiting UAVs", "had excused waiting: they waited for a UAV that worked", 0, true,
       [](const F& f) { return f.waiting_uavs; }},
      {"braking_hits", "Braking hits", "exchanges in which a UAV that brakes at once would touch the structure", 0,
       true, [](const F& f) { return f.braking_hits; }},
      {"braking_meets", "Braking meets", "exchanges in which two UAVs that both brake at once would touch", 0, true,
       [](const F& f) { return f.braking_meets; }},
      {"ways_meet", "Ways meet", "exchanges in which the braking trajectories of two UAVs touch", 0, false,
       [](const F& f) { return f.ways_meet; }},
      {"least_clearance_m", "Least clearance [m]", "of a body from the structure, as a sphere", 2, false,
       [](const F& f) { return f.least_clearance_m; }},
      {"least_separation_m", "Least separation [m]", "of two bodies, as spheres", 2, false,
       [](const F& f) { return f.least_separation_m; }},
      {"waited_s", "Waiting [s]", "for another UAV, as planners say; of the whole fleet", 0, true,
       [](const F& f) { return f.waited_s; }},
      {"idle_explorers_s", "Still explorer [s]",
       "slower than 0.1 m/s without a better capture for 5 s; a UAV on average", 0, true,
       [](const F& f) { return f.idle_explorers_s; }},
      {"idle_photographers_s", "Still photographer [s]", "the same of photographers", 0, true,
       [](const F& f) { return f.idle_photographers_s; }, true},
      {"distance_m", "Distance [m]", "flown by the whole fleet", 0, true, [](const F& f) { return f.distance_m; }},
      {"planner_cpu_ms", "Planner CPU [ms]", "for a UAV and simulated second", 1, true,
       [](const F& f) { return f.planner_cpu_ms; }},
      {"real_time_factor", "Times real time", "simulated time by time on the clock", 1, true,
       [](const F& f) { return f.real_time_factor; }},
      {"mission_time_s", "Mission time [s]", "from the first take-off on", 1, false,
       [](const F& f) { return f.mission_time_s; }}};
  return kColumns;
}

const StudyColumn& study_column(const std::string& name) {
  const auto found = std::ranges::find(study_columns(), name, &StudyColumn::name);
  if (found == study_columns().end()) throw std::out_of_range("there is no column " + name);
  return *found;
}

std::vector<double> column_values(const StudyColumn& column, const std::vector<const FlightEntry*>& flights) {
  std::vector<double> values;
  for (const FlightEntry* flight : flights) {
    if (!flight->figures) continue;
    if (const std::optional<double> value = column.value(*flight->figures)) values.push_back(*value);
  }
  return values;
}

}  // namespace skein::cli
