#include "uav_agent/planning/work_share.hpp"

#include <algorithm>

#include "uav_agent/flight/path_search.hpp"
#include "uav_agent/planning/survey.hpp"

namespace skein::agent {
namespace {

/// Time to fly a strip as far as the boxes alone let it be flown.
double work_seconds(const Strip& strip, const FreeSpace& by_boxes, const CameraReach& reach,
                    const StandoffConfig& standoff) {
  double length = 0.0;
  for (const Run& run : fit_strip(strip, false, 0.0, {}, by_boxes, reach, standoff)) {
    length += static_cast<double>(run.waypoints.size() - 1) * standoff.step_m;
  }
  return length / (standoff.ratio * reach.blur_speed_mps * standoff.speed_gain);
}

}  // namespace

WorkShare own_share(const AgentConfig& agent, const std::vector<OrientedBox>& boxes, const CameraReach& reach,
                    double middle_height_m, const WorkShareConfig& config) {
  const OccupancyMap nothing;
  const FreeSpace by_boxes({.use_map = false}, boxes, nothing);
  WorkShare share;
  std::vector<double> work_s;
  for (const Strip& strip : cut_into_strips(boxes, reach, config.strips)) {
    const double work = work_seconds(strip, by_boxes, reach, config.standoff);
    if (work <= 0.0) continue;
    share.strips.push_back(strip);
    work_s.push_back(work);
  }

  std::vector<Vector3d> starts;
  std::vector<double> free_at_s;
  for (const UavIndex i : FirstUavs(agent.fleet.size())) {
    AgentConfig other = agent;
    other.self = i;
    const auto ring = survey_ring(other, boxes, config.survey_standoff_m, 0.0);
    const bool surveys = config.survey && !ring.empty();
    const Vector3d start = surveys ? ring.back() : agent.fleet[i].p_WB_start;
    starts.emplace_back(start.x(), start.y(), middle_height_m);
    free_at_s.push_back(surveys ? path_length(ring.front(), ring) / config.survey_mps : 0.0);
  }
  share.tour = share_strips(share.strips, work_s, starts, free_at_s, config.transit_mps)[agent.self];
  return share;
}

}  // namespace skein::agent
