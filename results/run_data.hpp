// Reads a finished run to show it: result.json and the tables beside it (run_rows.hpp), sorted by UAV and point, with
// numbers that can be drawn. Of a damaged table it reads the rows before the damage; run_record.hpp rejects such a run.
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
  Vector3d center = Vector3d::Zero(), size = Vector3d::Zero();  ///< in W; full edge lengths [m]
  Eigen::Matrix3d R_WB = Eigen::Matrix3d::Identity();           ///< from the box's axes to W

  bool holds(const Vector3d& p_W) const;
};

/// An interest point and its score.
struct RunPoint {
  Vector3d p_W = Vector3d::Zero(), normal_W = Vector3d::Zero();
  double score = 0.0;
  double estimate = 0.0;             ///< attainable score; 0: none, or not known
  double loss = 0.0;                 ///< estimate - score; negative if the score is higher
  std::optional<std::size_t> cause;  ///< cause of the loss: index in kCauses
};

/// One interest point in one capture.
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

/// Viewing direction of a camera in W.
struct ViewAngles {
  double yaw = 0.0, pitch = 0.0;  ///< [rad]; yaw from x towards y; pitch is positive downwards
};
/// @param q_WB  attitude of the body. Pure.
ViewAngles view_angles(const Quaterniond& q_WB, const GimbalState& gimbal);

/// What a UAV did from this time on, as its program reported it.
struct RunActivity {
  double time_s = 0.0;
  std::string mode;    ///< in words: "flies to a goal"
  bool waits = false;  ///< for another UAV
};

struct RunPose {
  double time_s = 0.0;
  Vector3d p_WB = Vector3d::Zero();
  double speed = 0.0;  ///< [m/s]
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

/// Field of view of a UAV's camera, and the distance up to which its resolution is sufficient.
struct RunCamera {
  double hfov_deg = 0.0, vfov_deg = 0.0, range_m = 0.0;
};

struct RunFault {
  std::string kind, target;
  double from_s = 0.0, until_s = 0.0;
  bool ended = false;  ///< it ended before the run did
  bool by_hand = false;
};

struct RunData {
  Json result = Json::object();
  std::vector<std::string> uavs;                  ///< fleet order
  std::vector<bool> explorer;                     ///< by UAV
  std::vector<std::optional<RunCamera>> cameras;  ///< by UAV; nullopt: not in scene.json (earlier versions), or damaged
  std::vector<RunBox> boxes;
  std::vector<RunPoint> points;  ///< by index
  bool causes_known = false;     ///< there is a losses.csv
  std::vector<RunCapture> captures;
  std::vector<RunEvent> events;
  std::vector<std::vector<RunPose>> tracks;          ///< by UAV
  std::vector<std::vector<RunActivity>> activities;  ///< by UAV; none: its program reports no activity
  std::vector<RunScore> scores;
  std::vector<std::string> maps;  ///< by UAV: bytes of its map (octree_file.hpp); empty: none, or damaged
  std::vector<RunCollision> collisions;
  std::vector<RunFault> faults;  ///< faults that began in the run
  std::optional<Vector3d> station;
  double end_s = 0.0;                ///< end of the run [simulated s]
  std::vector<std::string> missing;  ///< sentences about missing and damaged files

  std::optional<std::size_t> uav_of(const std::string& name) const;
};

/// Reports damage in RunData::missing. @throws InputError if result.json in `dir` is missing or damaged.
RunData read_run_data(const std::filesystem::path& dir);
/// Reads only the fleet, captures and score over time, for a study. @throws InputError likewise.
RunData read_run_deliveries(const std::filesystem::path& dir);

}  // namespace skein::results
