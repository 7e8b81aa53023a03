// The lines of a feed (feed.hpp), which describe a flight; web/src/flight.js reads them. A line is a JSON object with
// its kind in "k" and the simulated time in "t" [s]. A fleet in flight and a finished run yield the same lines.
// Frame W (ENU); positions in cm and angles in mrad, as integers.   Pure; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/messages/activity.hpp"
#include "core/scenario/scenario.hpp"
#include "core/scoring/camera_quality.hpp"
#include "core/scoring/score_table.hpp"
#include "process/json_text.hpp"
#include "report/recorded_links.hpp"
#include "results/run_record.hpp"

namespace skein::view {

/// Time from one pose of a trail to the next.
inline constexpr double kTrailPeriod_s = 0.5;

/// A UAV at one moment.
struct ShownUav {
  RigidBodyState body;
  GimbalState gimbal;
  bool alive = true;
};

using ShownLink = report::LinkState;

/// Numbers that a UAV reports about itself.
struct ShownNumbers {
  double speed_mps = 0.0;
  std::uint32_t undelivered = 0;         ///< captures that are not delivered yet
  std::optional<double> cpu_per_s = {};  ///< CPU time per simulated second [s]
};

/// The data that do not change with time: "uavs" with their cameras, points, boxes, station; for a finished run also
/// its collisions, faults and causes of loss.
/// @param run  as far as it is known. @param cameras, range_m  by UAV: its camera, and how far the camera sees.
Json scene_json(const results::RunRecord& run, std::span<const CameraConfig> cameras, std::span<const double> range_m);

/// k: pose. "u": by UAV x, y, z, yaw and pitch of the camera's view (down is positive), 1 if the UAV is alive, else 0.
std::string pose_line(double time_s, std::span<const ShownUav> uavs);
/// The list "u" of pose_line(), for the feed's state.
std::string poses_json(std::span<const ShownUav> uavs);
/// k: links. "l": a digit (ShownLink) for each link; a row for each sender, node 0 (the station) first.
std::string links_line(double time_s, std::span<const ShownLink> row_major);
/// k: event. "e": the event, "s": its subject, "o": its object.
std::string event_line(double time_s, const std::string& event, const std::string& subject, const std::string& object);
/// k: activity. What the UAV "u" reports about its activity: "m": its mode, "g": its goal or null, "w": the UAV for
/// which it waits (empty: none), "n": why path search failed (empty: it found a path, or there was no search).
std::string activity_line(double time_s, std::size_t uav, const Activity& activity);
/// For the feed's state. By UAV: speed [cm/s], captures not delivered, CPU time per simulated second [ms] or null; null
/// for a UAV that reports nothing.
std::string numbers_json(std::span<const std::optional<ShownNumbers>> uavs);
/// k: fault. A fault begins ("on": 1) or ends (0) with the step at this time. "n": its number, among the faults of the
/// fault file ("hand": 0) or among those that a viewer has injected by hand (1); "kind" and "of" as in fault files.
struct ToldFault {
  std::uint64_t number = 0;
  bool by_hand = false;
  std::string kind, target;
};
std::string fault_line(double time_s, const ToldFault& fault, bool begins);
/// k: capture. "u": UAV, "c": the capture's number, "p": four integers for each point: its index minus that of the
/// point before it, q in 1/1000000 (fine enough to tell which of two nearly equal captures counts), q_blur and
/// q_distance in 1/1000. The encoding is compact because most of a large fleet's data are captures.
std::string capture_line(double time_s, std::size_t uav, std::uint64_t capture,
                         const std::vector<CapturePoint>& points);
/// A capture that was delivered to the station.
struct ShownDelivery {
  std::size_t uav = 0;
  std::uint64_t capture = 0;
};
/// k: delivered. "d": UAV and number of each capture that was delivered at this time.
std::string delivered_line(double time_s, std::span<const ShownDelivery> deliveries);
/// k: estimate. The attainable quality by interest point: "q" in 1/1000000, 0 if none. "no": indices of those points
/// with q > 0 that a camera could photograph from a place where no UAV fits, each minus the one before.
/// @param flyable  by interest point; 0: no UAV fits where the camera would have to be.
std::string estimate_line(double time_s, std::span<const float> q, std::span<const std::uint8_t> flyable);
/// k: void. The captures of the UAV "u" do not count, because it collided.
std::string void_line(double time_s, std::size_t uav);
/// k: score. "n": points detected, "s": score delivered, with all its digits.
std::string score_line(double time_s, std::size_t points, double score);

}  // namespace skein::view
