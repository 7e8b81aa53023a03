#include "results/run_data.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/files/file_bytes.hpp"
#include "results/causes.hpp"
#include "results/octree_file.hpp"
#include "results/result_file.hpp"
#include "results/run_folder.hpp"
#include "results/run_rows.hpp"
#include "results/run_tables.hpp"

namespace skein::results {
namespace {

namespace fs = std::filesystem;

/// Bound of plausible values [m, s, ...]: no run exceeds it, and a drawing of a larger number would be endless.
constexpr double kFarthest = 1e7;
constexpr std::uintmax_t kMostOfAMap = 64 << 20;

double sensible(double value) {
  if (!(std::abs(value) <= kFarthest)) throw std::runtime_error("a number is out of all bounds");
  return value;
}

Vector3d sensible(const Vector3d& value) { return {sensible(value.x()), sensible(value.y()), sensible(value.z())}; }

/// @throws if `numbers` is not an array of at least three plausible numbers.
Vector3d vector_in(const Json& numbers) {
  return {sensible(numbers.at(0).get<double>()), sensible(numbers.at(1).get<double>()),
          sensible(numbers.at(2).get<double>())};
}

RunData read_result(const fs::path& dir) {
  RunData data;
  data.result = read_result_file(dir);
  for (const Json& uav : value_or(data.result, "uavs", Json::array())) {
    data.uavs.push_back(text_in(uav, "name"));
    data.explorer.push_back(text_in(uav, "role") == "explorer");
  }
  data.tracks.resize(data.uavs.size());
  data.activities.resize(data.uavs.size());
  return data;
}

void read_scene(const fs::path& dir, RunData& data) {
  const Json scene = read_json(dir / run_folder::kScene);
  if (!scene.is_object()) data.missing.push_back(no_file(run_folder::kScene));
  try {
    for (const Json& box : value_or(scene, "boxes", Json::array())) {
      RunBox next{text_in(box, "name"), vector_in(box.at("center")), vector_in(box.at("size")), {}};
      for (int row = 0; row < 3; ++row) next.R_WB.row(row) = vector_in(box.at("rotation").at(row)).transpose();
      data.boxes.push_back(std::move(next));
    }
  } catch (const std::exception&) {
    data.missing.push_back("The boxes of scene.json are damaged.");
  }
  data.cameras.resize(data.uavs.size());
  for (const Json& json : value_or(scene, "cameras", Json::array())) {
    const auto uav = data.uav_of(text_in(json, "uav"));
    const RunCamera camera{number_in(json, "hfov_deg"), number_in(json, "vfov_deg"), number_in(json, "range_m")};
    const auto is_angle = [](double degrees) { return degrees > 0.0 && degrees < 180.0; };
    const bool sound =
        is_angle(camera.hfov_deg) && is_angle(camera.vfov_deg) && camera.range_m > 0.0 && camera.range_m < kFarthest;
    if (uav && sound) data.cameras[*uav] = camera;
  }
}

void read_points(const fs::path& dir, RunData& data) {
  each_sound_row<PointCells>(dir, data.missing, [&](const PointCells& row) {
    RunPoint point;
    point.p_W = sensible(row.p_W());
    point.normal_W = sensible(row.normal_W());
    point.score = sensible(row.score());
    data.points.push_back(point);
  });
  if (value_or(data.result, "losses", nullptr).is_null()) return;
  data.causes_known = fs::exists(dir / run_folder::kLosses);
  each_sound_row<LossCells>(dir, data.missing, [&](const LossCells& row) {
    const std::size_t index = row.index();
    if (index >= data.points.size()) throw std::runtime_error("there is no such point in score.csv");
    RunPoint& point = data.points[index];
    point.estimate = sensible(row.estimate());
    point.loss = sensible(row.loss());
    point.cause = cause_of(row.cause());
  });
}

/// Yaw 0 and pitch 0 if the row has no valid angles.
ViewAngles view_of(const PoseCells& row) try {
  const GimbalState gimbal = row.gimbal();
  const Quaterniond q_WB = row.q_WB();
  for (const double number : {gimbal.pitch, gimbal.yaw, q_WB.w(), q_WB.x(), q_WB.y(), q_WB.z()}) sensible(number);
  return view_angles(q_WB, gimbal);
} catch (const std::runtime_error&) {
  return {};
}

void read_tracks(const fs::path& dir, RunData& data) {
  each_sound_row<PoseCells>(dir, data.missing, [&](const PoseCells& row) {
    const auto uav = data.uav_of(row.uav());
    if (!uav) return;
    data.tracks[*uav].push_back(
        {sensible(row.time_s()), sensible(row.p_W()), sensible(row.v_W()).norm(), row.alive(), view_of(row)});
  });
}

void read_deliveries(const fs::path& dir, RunData& data) {
  each_sound_row<CaptureCells>(dir, data.missing, [&](const CaptureCells& row) {
    const auto uav = data.uav_of(row.uav());
    if (!uav) return;
    RunCapture capture{*uav, row.capture(), sensible(row.time_s()), sensible(row.q()), row.point()};
    if (const auto at_s = row.delivered_at_s()) capture.delivered_at_s = sensible(*at_s);
    capture.voided = row.reason() == run_tables::kUavCollided;
    data.captures.push_back(capture);
  });
}

void read_events(const fs::path& dir, RunData& data) {
  each_sound_row<EventCells>(dir, data.missing, [&](const EventCells& row) {
    data.events.push_back({sensible(row.time_s()), row.event(), row.subject(), row.object()});
  });
}

/// Runs of earlier versions have no such table.
void read_activities(const fs::path& dir, RunData& data) {
  if (!fs::exists(dir / run_folder::kActivity)) return;
  each_sound_row<ActivityCells>(dir, data.missing, [&](const ActivityCells& row) {
    const auto uav = data.uav_of(row.uav());
    const Activity activity = row.activity();
    if (uav) data.activities[*uav].push_back({sensible(row.time_s()), activity.mode, !activity.waits_for.empty()});
  });
}

void read_scores(const fs::path& dir, RunData& data) {
  each_sound_row<ScoreCells>(dir, data.missing, [&](const ScoreCells& row) {
    data.scores.push_back({sensible(row.time_s()), sensible(row.points()), sensible(row.score())});
  });
}

/// Calls `entry` with each element of an array in result.json; leaves out elements for which it throws.
void read_entries(const RunData& data, const char* key, const auto& entry) {
  for (const Json& json : value_or(data.result, key, Json::array())) {
    try {
      entry(json);
    } catch (const std::exception&) {
    }
  }
}

/// A UAV that a user's own program flies leaves no map.
void read_maps(const fs::path& dir, RunData& data) {
  for (const std::string& uav : data.uavs) {
    std::string& map = data.maps.emplace_back();
    const std::string name = run_folder::map_file(uav);
    if (!fs::exists(dir / name)) continue;
    try {
      map = read_file_bytes(dir / name, kMostOfAMap);
    } catch (const InputError&) {
    }
    if (visit_octree_file(map, [](const KnownCube&) {})) continue;
    map.clear();
    data.missing.push_back(name + " is damaged.");
  }
}

void read_incidents(RunData& data) {
  read_entries(data, "collisions", [&](const Json& json) {
    RunCollision collision{sensible(number_in(json, "time_s")), text_in(json, "uav"), text_in(json, "with"), {}};
    if (json.contains("position") && json["position"].is_array()) collision.p_W = vector_in(json["position"]);
    data.collisions.push_back(std::move(collision));
  });
  const double step_s = number_in(data.result, "exchange_period_s");
  read_entries(data, "faults", [&](const Json& json) {
    const auto began = number_if_any(json, "began_step"), ended = number_if_any(json, "ended_step");
    if (!began) return;
    data.faults.push_back({text_in(json, "kind"), text_in(json, "target"), sensible(*began * step_s),
                           ended ? sensible(*ended * step_s) : data.end_s, ended.has_value()});
  });
  // Faults that a viewer added by hand come after those of the fault file.
  std::size_t by_hand = 0;
  read_entries(data, "interventions", [&](const Json& json) { by_hand += text_in(json, "what") == "begin" ? 1 : 0; });
  for (std::size_t i = data.faults.size() - std::min(by_hand, data.faults.size()); i < data.faults.size(); ++i) {
    data.faults[i].by_hand = true;
  }
  try {
    data.station = vector_in(data.result.at("station").at("position"));
  } catch (const std::exception&) {  // earlier versions did not write it
  }
}

double end_of(const RunData& data) {
  double end_s = std::clamp(number_in(data.result, "sim_time_s"), 0.0, kFarthest);
  for (const auto& track : data.tracks) {
    if (!track.empty()) end_s = std::max(end_s, track.back().time_s);
  }
  if (!data.events.empty()) end_s = std::max(end_s, data.events.back().time_s);
  if (!data.scores.empty()) end_s = std::max(end_s, data.scores.back().time_s);
  return end_s;
}

}  // namespace

bool RunBox::holds(const Vector3d& p_W) const {
  const Vector3d p_B = R_WB.transpose() * (p_W - center);
  return (p_B.array().abs() <= 0.5 * size.array()).all();
}

std::optional<std::size_t> RunData::uav_of(const std::string& name) const {
  const auto found = std::find(uavs.begin(), uavs.end(), name);
  return found == uavs.end() ? std::nullopt : std::optional<std::size_t>(found - uavs.begin());
}

ViewAngles view_angles(const Quaterniond& q_WB, const GimbalState& gimbal) {
  RigidBodyState body;
  body.q_WB = q_WB;
  // The camera looks along its x axis. Its mounting position and its optics do not affect the direction.
  const Vector3d axis = camera_state(body, gimbal, CameraConfig{}).X_WC.linear() * Vector3d::UnitX();
  return {std::atan2(axis.y(), axis.x()), std::asin(std::clamp(-axis.z(), -1.0, 1.0))};
}

RunData read_run_data(const fs::path& dir) {
  RunData data = read_result(dir);
  read_scene(dir, data);
  read_points(dir, data);
  read_tracks(dir, data);
  read_deliveries(dir, data);
  read_events(dir, data);
  read_activities(dir, data);
  read_scores(dir, data);
  read_maps(dir, data);
  data.end_s = end_of(data);
  read_incidents(data);
  return data;
}

RunData read_run_deliveries(const fs::path& dir) {
  RunData data = read_result(dir);
  read_deliveries(dir, data);
  read_scores(dir, data);
  data.end_s = end_of(data);
  return data;
}

}  // namespace skein::results
