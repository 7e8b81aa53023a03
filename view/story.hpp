// A flight in lines, as a page is told it (web/src/flight.js reads them): JSON objects, each with what it is in "k" and
// the simulated time in "t" [s]. The same lines come from a fleet that flies and from the folder of a run that is over.
// Frame W (ENU); positions in cm, angles in mrad, whole numbers.   Pure; any thread.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/camera_quality.hpp"
#include "core/scenario.hpp"
#include "core/score_table.hpp"
#include "process/json_text.hpp"
#include "report/run_data.hpp"

namespace skein::view {

/// Between two poses of a trail.
inline constexpr double kTrailPeriod_s = 0.5;

/// A UAV at one moment.
struct ShownUav {
  RigidBodyState body;
  GimbalState gimbal;
  bool alive = true;
};

enum class ShownLink : std::uint8_t { blocked, linked, cut, dead };

/// What has no time: "uavs" with their cameras, points, boxes, station; what is known of a finished run, too.
/// @param run  as far as it is known. @param cameras  by UAV. @param range_m  how far they see, by UAV.
Json scene_json(const report::RunData& run, std::span<const CameraConfig> cameras, std::span<const double> range_m);

/// k: pose. "u": by UAV x, y, z, yaw and pitch of the view (down is positive), 1 if alive.
std::string pose_line(double time_s, std::span<const ShownUav> uavs);
/// The same list, for a state.
std::string poses_json(std::span<const ShownUav> uavs);
/// k: links. "l": a digit of ShownLink for each, row by sender, node 0 (the station) first.
std::string links_line(double time_s, std::span<const ShownLink> row_major);
/// k: event. "e": what, "s": of whom, "o": with whom or what.
std::string event_line(double time_s, const std::string& event, const std::string& subject, const std::string& object);
/// k: capture. "u": UAV, "c": its number, "p": for each point its index, q, and q_blur, q_res, q_distance.
std::string capture_line(double time_s, std::size_t uav, std::uint64_t capture,
                         const std::vector<CapturePoint>& points);
/// k: delivered. "u", "c" as before.
std::string delivered_line(double time_s, std::size_t uav, std::uint64_t capture);
/// k: void. The captures of "u" do not count: it collided.
std::string void_line(double time_s, std::size_t uav);
/// k: score. "n": points, "s": delivered, exact.
std::string score_line(double time_s, std::size_t points, double score);

}  // namespace skein::view
