// A flight in lines, as a page is told it (web/src/flight.js reads them): JSON objects, each with what it is in "k" and
// the simulated time in "t" [s]. The same lines come from a fleet that flies and from the folder of a run that is over.
// Frame W (ENU); positions in cm, angles in mrad, whole numbers.   Pure; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/activity.hpp"
#include "core/camera_quality.hpp"
#include "core/scenario.hpp"
#include "core/scoring/score_table.hpp"
#include "process/json_text.hpp"
#include "report/recorded_links.hpp"
#include "results/run_data.hpp"

namespace skein::view {

/// Between two poses of a trail.
inline constexpr double kTrailPeriod_s = 0.5;

/// A UAV at one moment.
struct ShownUav {
  RigidBodyState body;
  GimbalState gimbal;
  bool alive = true;
};

using ShownLink = report::LinkState;

/// What a UAV says of itself in numbers.
struct ShownNumbers {
  double speed_mps = 0.0;
  std::uint32_t undelivered = 0;
  std::optional<double> cpu_per_s = {};  ///< CPU time for a simulated second [s]
};

/// What has no time: "uavs" with their cameras, points, boxes, station; what is known of a finished run, too.
/// @param run  as far as it is known. @param cameras  by UAV. @param range_m  how far they see, by UAV.
Json scene_json(const results::RunData& run, std::span<const CameraConfig> cameras, std::span<const double> range_m);

/// k: pose. "u": by UAV x, y, z, yaw and pitch of the view (down is positive), 1 if alive.
std::string pose_line(double time_s, std::span<const ShownUav> uavs);
/// The same list, for a state.
std::string poses_json(std::span<const ShownUav> uavs);
/// k: links. "l": a digit of ShownLink for each, row by sender, node 0 (the station) first.
std::string links_line(double time_s, std::span<const ShownLink> row_major);
/// k: event. "e": what, "s": of whom, "o": with whom or what.
std::string event_line(double time_s, const std::string& event, const std::string& subject, const std::string& object);
/// k: activity. What the UAV "u" says that it does: "m" mode, "g" its goal or null, "w" whom it waits for, "n" why it
/// finds no way; empty texts: nobody, it does.
std::string activity_line(double time_s, std::size_t uav, const Activity& activity);
/// For a state. By UAV: speed [cm/s], captures not delivered, CPU time for a simulated second [ms] or null; null for a
/// UAV that says nothing.
std::string numbers_json(std::span<const std::optional<ShownNumbers>> uavs);
/// k: fault. One begins ("on": 1) or ends with the step at this time. "n": its number, among those of the fault file or
/// among those that somebody who watches has begun ("hand": 1); "kind" and "of" as fault files spell them.
struct ToldFault {
  std::uint64_t number = 0;
  bool by_hand = false;
  std::string kind, target;
};
std::string fault_line(double time_s, const ToldFault& fault, bool begins);
/// k: capture. "u": UAV, "c": its number, "p": for each point four whole numbers: its index less that of the point
/// before it, q in 1/1000000 (of two that are
/// nearly as good one counts), q_blur and q_distance in 1/1000. A large fleet tells more of these than of all else.
std::string capture_line(double time_s, std::size_t uav, std::uint64_t capture,
                         const std::vector<CapturePoint>& points);
/// A capture that came to the station.
struct ShownDelivery {
  std::size_t uav = 0;
  std::uint64_t capture = 0;
};
/// k: delivered. "d": UAV and number of each capture that came at this time.
std::string delivered_line(double time_s, std::span<const ShownDelivery> deliveries);
/// k: estimate. What could be had, by interest point: "q" in 1/1000000, 0 where nothing; "no": the points of these that
/// a camera could photograph and no UAV, each less the one before.
/// @param flyable  by interest point; 0: no UAV fits there.
std::string estimate_line(double time_s, std::span<const float> q, std::span<const std::uint8_t> flyable);
/// k: void. The captures of "u" do not count: it collided.
std::string void_line(double time_s, std::size_t uav);
/// k: score. "n": points, "s": delivered, exact.
std::string score_line(double time_s, std::size_t points, double score);

}  // namespace skein::view
