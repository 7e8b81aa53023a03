// The referee's record of work: what each UAV did in each second, and whether there was work for it. It uses the true
// state, and is for reports only: no agent receives it, and no digest contains it. core/run/work_time.hpp judges it.
// Frame W.   Units: m, s, score.   Threads: one.   Pure: knows no bus.
//
// The work of a UAV is
// - surface mapped: interest points that its key frame shows and that neither it nor a UAV linked to it knew before;
// - score gained: the amount by which its captures raise the best scores of the fleet;
// - score delivered: the same of the captures whose delivery to the station has been acknowledged to their UAVs.
// A point is open for a UAV if
// - no UAV has photographed it at least half as well as is possible from its workplace (workplaces.hpp); for the
//   LiDAR, it is open only if in addition neither the UAV nor a UAV linked to it has mapped it; and
// - the UAV could fly to the workplace, and from there to the station, at 4 m/s (or at its maximum speed if that is
//   less), on paths 1.5 times as long as straight lines, and have 10 s left before the mission ends.
// The unit of work is the least amount. It follows from the sum of all open work in that second, and is a tenth of the
// UAV's share per minute if all of it were done by the end: open / 10 * 60 s / time left / number of UAVs alive (for
// mapping: of those with a LiDAR), with a time left of 60 s at least, and no less than kLeastScore or kLeastMapped. A
// second counts as open only if the open score or the open number of points is at least twice kLeastScore or
// kLeastMapped, and at least 2 % of all that the scene holds for the UAV, because a few corners always remain.
//
// So no point is open for a UAV that must return. Work that needs a failed sensor is not open. After the mission has
// begun, or a UAV's program has come back, nothing counts as open for 15 s plus the time to the nearest open workplace.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/run/work_time.hpp"
#include "core/scoring/score_table.hpp"
#include "sim_server/simulation.hpp"
#include "sim_server/work/mapped_surface.hpp"
#include "sim_server/work/workplaces.hpp"

namespace skein::sim {

class WorkLog {
 public:
  static constexpr double kLeastScore = 1.0;
  static constexpr double kLeastMapped = 4.0;  ///< number of points

  /// Both must outlive this.
  WorkLog(const Scenario& scenario, const Simulation& simulation);

  /// Call it once per step, when the step is answered. @param is_member  whether the program of this name is a member.
  void end_step(const std::function<bool(const std::string&)>& is_member);
  /// The station's acknowledgement of a capture has reached this UAV.
  void add_release(UavIndex uav, std::uint64_t capture);

  /// Tracks in fleet order, up to the last whole second.
  const std::vector<WorkTrack>& tracks() const { return tracks_; }

 private:
  struct Gains {
    double mapped = 0.0, score = 0.0, delivered = 0.0;
  };
  /// Open work for a UAV.
  struct Open {
    double score = 0.0, mapped = 0.0;
    double nearest_m = 0.0;  ///< distance to the nearest open workplace
  };
  struct Uav {
    double all_score = 0.0, all_points = 0.0;  ///< all work that the scene holds for it
    std::vector<bool> mapped;                  ///< by interest point: whether the UAV has it in its map
    Gains gains;                               ///< work in this second
    std::optional<double> ready_s;             ///< from when on open work counts; nullopt: it is away
  };

  void add_key_frame(const KeyFrameEvent& event);
  void add_capture(const CaptureReport& report);
  /// @returns the sum over all points of the rise of the best score.
  static double add(const CaptureReport& report, ScoreTable& table, std::vector<float>& best);
  void take_out(UavIndex uav);
  void end_second(const std::function<bool(const std::string&)>& is_member);
  Open open_for(UavIndex uav, bool camera_works, bool lidar_works) const;
  std::vector<bool> mapped_in_reach(UavIndex uav) const;
  /// @returns the work of this second in least amounts, and whether enough work is open.
  std::pair<double, bool> weigh(const Uav& uav, const Open& open) const;

  const Scenario& scenario_;
  const Simulation& simulation_;
  const std::vector<std::string> names_;
  const Workplaces places_;
  const MappedSurface surface_;
  std::vector<Uav> uavs_;
  ScoreTable earned_, delivered_;
  std::vector<float> best_earned_, best_delivered_;                          ///< by point: best scores of the fleet
  std::map<std::pair<std::size_t, std::uint64_t>, CaptureReport> captures_;  ///< not yet delivered
  std::vector<WorkTrack> tracks_;
};

}  // namespace skein::sim
