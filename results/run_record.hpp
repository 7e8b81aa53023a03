// Reads the folder of a finished run: result.json, the rows of the tables beside it (run_rows.hpp), scene.json and
// maps. Code that judges a run reads it with read_run(), which refuses damage; pages read it with read_sound_run(),
// which reads each table up to the first damaged row.
// Frame W (ENU), metres, metres per second, simulated seconds and steps.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/types.hpp"
#include "process/json_text.hpp"
#include "results/run_rows.hpp"

namespace skein::results {

struct RunBox {
  std::string name;
  Vector3d center = Vector3d::Zero(), size = Vector3d::Zero();  ///< in W; full edge lengths [m]
  Eigen::Matrix3d R_WB = Eigen::Matrix3d::Identity();           ///< from the box's axes to W

  bool holds(const Vector3d& p_W) const;
};

/// An interest point with its loss.
struct RunPoint : PointRow {
  double estimate = 0.0;                  ///< attainable score; 0: none, or not known
  double loss = 0.0;                      ///< estimate - score; negative if the score is higher
  std::optional<std::size_t> cause = {};  ///< cause of the loss: index in kCauses
};

/// Viewing direction of a camera in W.
struct ViewAngles {
  double yaw = 0.0, pitch = 0.0;  ///< [rad]; yaw from x towards y; pitch is positive downwards
};
/// @param q_WB  attitude of the body. Pure.
ViewAngles view_angles(const Quaterniond& q_WB, const GimbalState& gimbal);

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

/// What a reader did not read is empty.
struct RunRecord {
  std::filesystem::path dir;

  // From result.json.
  Json result = Json::object();
  std::vector<std::string> uavs;  ///< fleet order
  std::vector<bool> explorer;     ///< by UAV
  std::vector<RunCollision> collisions;
  std::vector<RunFault> faults;  ///< faults that began in the run
  std::optional<Vector3d> station;
  double end_s = 0.0;  ///< end of the run [simulated s]

  // From tables, in their order.
  std::vector<CaptureRow> captures;
  std::vector<EventRow> events;      ///< by step
  std::vector<MessageRow> messages;  ///< by step
  std::vector<PoseRow> poses;        ///< by time
  std::vector<ScoreRow> scores;      ///< by time
  std::vector<WorkRow> work;         ///< by time
  std::vector<ActivityRow> activities;
  std::vector<RunPoint> points;  ///< by index
  bool causes_known = false;     ///< there is a losses.csv

  std::vector<RunBox> boxes;
  std::vector<std::optional<RunCamera>> cameras;  ///< by UAV; nullopt: not in scene.json (earlier versions), or damaged
  std::vector<std::string> maps;  ///< by UAV: bytes of its map (octree_file.hpp); empty: none, or damaged

  std::vector<std::string> missing;  ///< sentences about missing and damaged files

  std::optional<std::size_t> uav_of(const std::string& name) const;

  /// The rows of each UAV, in fleet order. @param rows  must outlive the result
  template <class Row>
  std::vector<std::vector<const Row*>> by_uav(const std::vector<Row>& rows) const {
    std::vector<std::vector<const Row*>> parts(uavs.size());
    for (const Row& row : rows) {
      if (const auto uav = uav_of(row.uav)) parts[*uav].push_back(&row);
    }
    return parts;
  }
};

/// Reads a run to judge it: result.json, captures, events, messages, poses, scores and work. A missing table counts as
/// empty, since its program may have died.
/// @throws std::runtime_error if result.json is missing or damaged, or a row is invalid. It is not an InputError,
///   because the run is wrong, not the user's input.
RunRecord read_run(const std::filesystem::path& dir);

/// Reads all of a run that pages show. Leaves out rows of UAVs that are not in result.json, and reports damage in
/// RunRecord::missing. @throws InputError if result.json in `dir` is missing or damaged.
RunRecord read_sound_run(const std::filesystem::path& dir);
/// The sentences in RunRecord::missing about files that are there, but damaged. @throws like read_sound_run()
std::vector<std::string> damaged_files(const std::filesystem::path& dir);
/// The same as read_sound_run(), but only of result.json and these files. @param files  names as in run_folder.hpp
RunRecord read_sound_files(const std::filesystem::path& dir, std::initializer_list<std::string_view> files);

}  // namespace skein::results
