// The referee's record of who works: what each UAV did in each second, and whether there was anything to do for it. By
// the truth, for reports alone: no agent hears of it, and no digest has it. core/run/work_time.hpp judges it.
// Frame W.   Units: m, s, score.   Threads: one.   Pure: knows no bus.
//
// Work is
// - surface mapped: interest points that a key frame shows for the first time to the UAV and all mates linked to it;
// - score gained: what its captures add to the best of the fleet;
// - score delivered: what its captures add to what UAVs were told that the station has.
// Each is counted in least amounts, which depend on what is open for it in that second. Open for a UAV is a point
// - that nobody has photographed half as well as it could be from its workplace (workplaces.hpp), or, for mapping, that
//   neither it nor a mate linked to it has mapped either;
// - whose workplace it could fly to, and from there on to the station, at 4 m/s, or at its maximum speed if that is
//   less, on ways half as long again as straight lines, with 10 s left before the mission ends.
// Of a sum `open` the least amount is a tenth of what it would have to do in a minute if all were done by the end,
// open / 10 * 60 s / time left / UAVs that could do it (time left: 60 s or more), and no less than kLeastScore or
// kLeastMapped. Less than twice kLeastScore or kLeastMapped in all, or 2 % of all that the scene holds for the UAV, is
// not held against it: a few corners are always left.
//
// So nothing is open for a UAV that has to turn home. Nothing is, either, for 15 s and the time to the nearest open
// workplace after the mission begins or its program has come back, and of what needs a sensor that has failed.
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
  static constexpr double kLeastMapped = 4.0;  ///< points

  /// Both must outlive this.
  WorkLog(const Scenario& scenario, const Simulation& simulation);

  /// Once a step, when it has been answered. @param is_member  of the run, by name.
  void end_step(const std::function<bool(const std::string&)>& is_member);
  /// The station's acknowledgement of a capture has reached this UAV.
  void add_release(UavIndex uav, std::uint64_t capture);

  /// In fleet order; whole seconds so far.
  const std::vector<WorkTrack>& tracks() const { return tracks_; }

 private:
  struct Gains {
    double mapped = 0.0, score = 0.0, delivered = 0.0;
  };
  /// What is open for a UAV.
  struct Open {
    double score = 0.0, mapped = 0.0;
    double nearest_m = 0.0;  ///< way to its workplace
  };
  struct Uav {
    double all_score = 0.0, all_points = 0.0;  ///< that the scene holds for it
    std::vector<bool> mapped;                  ///< by interest point: known to it
    Gains gains;                               ///< in this second
    std::optional<double> ready_s;             ///< when it could have begun; none: it is away
  };

  void add_key_frame(const KeyFrameEvent& event);
  void add_capture(const CaptureReport& report);
  /// @returns what the best of a point rose by, in all.
  static double add(const CaptureReport& report, ScoreTable& table, std::vector<float>& best);
  void take_out(UavIndex uav);
  void end_second(const std::function<bool(const std::string&)>& is_member);
  Open open_for(UavIndex uav, bool camera_works, bool lidar_works) const;
  std::vector<bool> mapped_in_reach(UavIndex uav) const;
  /// @returns work in least amounts, and whether there was any.
  std::pair<double, bool> weigh(const Uav& uav, const Open& open) const;

  const Scenario& scenario_;
  const Simulation& simulation_;
  const std::vector<std::string> names_;
  const Workplaces places_;
  const MappedSurface surface_;
  std::vector<Uav> uavs_;
  ScoreTable earned_, delivered_;
  std::vector<float> best_earned_, best_delivered_;                          ///< by point, of the fleet
  std::map<std::pair<std::size_t, std::uint64_t>, CaptureReport> captures_;  ///< that were not delivered yet
  std::vector<WorkTrack> tracks_;
};

}  // namespace skein::sim
