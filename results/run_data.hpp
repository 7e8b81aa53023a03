// A finished run, read for showing it: result.json and the tables beside it (run_rows.hpp), whole or as far as they go,
// by UAV and point, in numbers that can be drawn. Who judges a run reads run_record.hpp, which takes no damage.
// Frame W (ENU), metres, simulated seconds.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/camera_quality.hpp"
#include "core/types.hpp"
#include "process/json_text.hpp"

namespace skein::results {

struct RunBox {
  std::string name;
  Vector3d center = Vector3d::Zero(), size = Vector3d::Zero();
  Eigen::Matrix3d R_WB = Eigen::Matrix3d::Identity();

  bool holds(const Vector3d& p_W) const;
};

/// An interest point, and what became of it.
struct RunPoint {
  Vector3d p_W = Vector3d::Zero(), normal_W = Vector3d::Zero();
  double score = 0.0;
  double estimate = 0.0;             ///< what could be had; 0: nothing, or not known
  double loss = 0.0;                 ///< estimate - score; negative above the estimate
  std::optional<std::size_t> cause;  ///< of the loss, of kCauses
};

/// A point in a picture.
struct RunCapture {
  std::size_t uav = 0;
  std::uint64_t capture = 0;
  double time_s = 0.0, q = 0.0;
  std::size_t point = 0;
  std::optional<double> delivered_at_s = {};
  bool voided = false;  ///< the UAV collided
};

struct RunEvent {
  double time_s = 0.0;
  std::string event, subject, object;
};

/// Where a camera looks, in W.
struct ViewAngles {
  double yaw = 0.0, pitch = 0.0;  ///< [rad]; down is positive
};
/// @param q_WB  of the body. Pure.
ViewAngles view_angles(const Quaterniond& q_WB, const GimbalState& gimbal);

struct RunPose {
  double time_s = 0.0;
  Vector3d p_WB = Vector3d::Zero();
  double speed = 0.0;
  bool alive = true;
  ViewAngles view = {};
};

struct RunScore {
  double time_s = 0.0, points = 0.0, score = 0.0;
};

struct RunCollision {
  double time_s = 0.0;
  std::string uav, with;
  std::optional<Vector3d> p_W;
};

/// What a UAV's camera sees sharp enough.
struct RunCamera {
  double hfov_deg = 0.0, vfov_deg = 0.0, range_m = 0.0;
};

struct RunFault {
  std::string kind, target;
  double from_s = 0.0, until_s = 0.0;
  bool ended = false;  ///< not only with the run
  bool by_hand = false;
};

struct RunData {
  Json result = Json::object();
  std::vector<std::string> uavs;                  ///< fleet order
  std::vector<bool> explorer;                     ///< by UAV
  std::vector<std::optional<RunCamera>> cameras;  ///< by UAV; none: a recording of an earlier version
  std::vector<RunBox> boxes;
  std::vector<RunPoint> points;  ///< by index
  bool causes_known = false;     ///< there is a losses.csv
  std::vector<RunCapture> captures;
  std::vector<RunEvent> events;
  std::vector<std::vector<RunPose>> tracks;  ///< by UAV
  std::vector<RunScore> scores;
  std::vector<std::string> maps;  ///< by UAV: a sound file of octree_file.hpp's; empty: it left none
  std::vector<RunCollision> collisions;
  std::vector<RunFault> faults;  ///< those that happened
  std::optional<Vector3d> station;
  double end_s = 0.0;                ///< of the simulated time
  std::vector<std::string> missing;  ///< in sentences: tables that are not there, or not whole

  std::optional<std::size_t> uav_of(const std::string& name) const;
};

/// What is damaged counts as missing. @throws InputError when there is no result.json in `dir`.
RunData read_run_data(const std::filesystem::path& dir);
/// Its fleet, captures and score over time alone: what a study reads of each flight. @throws InputError likewise.
RunData read_run_deliveries(const std::filesystem::path& dir);

}  // namespace skein::results
