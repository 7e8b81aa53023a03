#include "results/run_record.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/files/file_bytes.hpp"
#include "core/scoring/camera_quality.hpp"
#include "results/causes.hpp"
#include "results/octree_file.hpp"
#include "results/result_file.hpp"

namespace skein::results {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMostOfAMap = 64 << 20;

double sensible(double value) {
  if (!(std::abs(value) <= kFarthest)) throw std::runtime_error("a number is out of range");
  return value;
}

/// @throws if `numbers` is not an array of at least three plausible numbers.
Vector3d vector_in(const Json& numbers) {
  return {sensible(numbers.at(0).get<double>()), sensible(numbers.at(1).get<double>()),
          sensible(numbers.at(2).get<double>())};
}

RunRecord read_result(const fs::path& dir) {
  RunRecord run;
  run.dir = dir;
  run.result = read_result_file(dir);
  for (const Json& uav : value_or(run.result, "uavs", Json::array())) {
    run.uavs.push_back(text_in(uav, "name"));
    run.explorer.push_back(text_in(uav, "role") == "explorer");
  }
  return run;
}

void read_scene(RunRecord& run) {
  const Json scene = read_json(run.dir / run_folder::kScene);
  if (!scene.is_object()) run.missing.push_back(no_file(run_folder::kScene));
  try {
    for (const Json& box : value_or(scene, "boxes", Json::array())) {
      RunBox next{text_in(box, "name"), vector_in(box.at("center")), vector_in(box.at("size")), {}};
      for (int row = 0; row < 3; ++row) next.R_WB.row(row) = vector_in(box.at("rotation").at(row)).transpose();
      run.boxes.push_back(std::move(next));
    }
  } catch (const std::exception&) {
    run.missing.push_back("The boxes of scene.json are damaged.");
  }
  run.cameras.resize(run.uavs.size());
  for (const Json& json : value_or(scene, "cameras", Json::array())) {
    const auto uav = run.uav_of(text_in(json, "uav"));
    const RunCamera camera{number_in(json, "hfov_deg"), number_in(json, "vfov_deg"), number_in(json, "range_m")};
    const auto is_angle = [](double degrees) { return degrees > 0.0 && degrees < 180.0; };
    const bool sound =
        is_angle(camera.hfov_deg) && is_angle(camera.vfov_deg) && camera.range_m > 0.0 && camera.range_m < kFarthest;
    if (uav && sound) run.cameras[*uav] = camera;
  }
}

void read_points(RunRecord& run) {
  each_sound_row<PointRow>(run.dir, run.missing, [&](const PointRow& row) { run.points.push_back({row}); });
}

void read_losses(RunRecord& run) {
  if (value_or(run.result, "losses", nullptr).is_null()) return;
  run.causes_known = fs::exists(run.dir / run_folder::kLosses);
  each_sound_row<LossRow>(run.dir, run.missing, [&](const LossRow& row) {
    if (row.point >= run.points.size()) throw std::runtime_error("there is no such point in score.csv");
    RunPoint& point = run.points[row.point];
    point.estimate = row.estimate;
    point.loss = row.loss;
    point.cause = cause_of(row.cause);
  });
}

template <class Row>
void read_sound_rows(RunRecord& run, std::vector<Row>& rows) {
  each_sound_row<Row>(run.dir, run.missing, [&](Row row) {
    if constexpr (requires { row.uav; }) {
      if (!run.uav_of(row.uav)) return;
    }
    rows.push_back(std::move(row));
  });
}

/// Calls `entry` with each element of an array in result.json; leaves out elements for which it throws.
void read_entries(const RunRecord& run, const char* key, const auto& entry) {
  for (const Json& json : value_or(run.result, key, Json::array())) {
    try {
      entry(json);
    } catch (const std::exception&) {
    }
  }
}

/// A UAV that a user's own program flies leaves no map.
void read_maps(RunRecord& run, const auto& wants) {
  for (const std::string& uav : run.uavs) {
    std::string& map = run.maps.emplace_back();
    const std::string name = run_folder::map_file(uav);
    if (!wants(name) || !fs::exists(run.dir / name)) continue;
    try {
      map = read_file_bytes(run.dir / name, kMostOfAMap);
    } catch (const InputError&) {
    }
    if (visit_octree_file(map, [](const KnownCube&) {})) continue;
    map.clear();
    run.missing.push_back(name + " is damaged.");
  }
}

void read_incidents(RunRecord& run) {
  read_entries(run, "collisions", [&](const Json& json) {
    RunCollision collision{sensible(number_in(json, "time_s")), text_in(json, "uav"), text_in(json, "with"), {}};
    if (json.contains("position") && json["position"].is_array()) collision.p_W = vector_in(json["position"]);
    run.collisions.push_back(std::move(collision));
  });
  const double step_s = number_in(run.result, "exchange_period_s");
  read_entries(run, "faults", [&](const Json& json) {
    const auto began = number_if_any(json, "began_step"), ended = number_if_any(json, "ended_step");
    if (!began) return;
    run.faults.push_back({text_in(json, "kind"), text_in(json, "target"), sensible(*began * step_s),
                          ended ? sensible(*ended * step_s) : run.end_s, ended.has_value()});
  });
  // Faults that a viewer added by hand come after those of the fault file.
  std::size_t by_hand = 0;
  read_entries(run, "interventions", [&](const Json& json) { by_hand += text_in(json, "what") == "begin" ? 1 : 0; });
  for (std::size_t i = run.faults.size() - std::min(by_hand, run.faults.size()); i < run.faults.size(); ++i) {
    run.faults[i].by_hand = true;
  }
  try {
    run.station = vector_in(run.result.at("station").at("position"));
  } catch (const std::exception&) {  // earlier versions did not write it
  }
}

double end_of(const RunRecord& run) {
  double end_s = std::clamp(number_in(run.result, "sim_time_s"), 0.0, kFarthest);
  if (!run.poses.empty()) end_s = std::max(end_s, run.poses.back().time_s);
  if (!run.events.empty()) end_s = std::max(end_s, run.events.back().time_s);
  if (!run.scores.empty()) end_s = std::max(end_s, run.scores.back().time_s);
  return end_s;
}

/// @param wants  whether to read a file of this name
RunRecord read_sound(const fs::path& dir, const auto& wants) {
  RunRecord run = read_result(dir);
  if (wants(run_folder::kScene)) read_scene(run);
  if (wants(run_folder::kScore)) read_points(run);
  if (wants(run_folder::kLosses)) read_losses(run);
  if (wants(run_folder::kTrajectories)) read_sound_rows(run, run.poses);
  if (wants(run_folder::kCaptures)) read_sound_rows(run, run.captures);
  if (wants(run_folder::kEvents)) read_sound_rows(run, run.events);
  // Runs of earlier versions have no such table.
  if (wants(run_folder::kActivity) && fs::exists(dir / run_folder::kActivity)) read_sound_rows(run, run.activities);
  if (wants(run_folder::kScoreTimeline)) read_sound_rows(run, run.scores);
  read_maps(run, wants);
  run.end_s = end_of(run);
  read_incidents(run);
  return run;
}

}  // namespace

bool RunBox::holds(const Vector3d& p_W) const {
  const Vector3d p_B = R_WB.transpose() * (p_W - center);
  return (p_B.array().abs() <= 0.5 * size.array()).all();
}

std::optional<std::size_t> RunRecord::uav_of(const std::string& name) const {
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

RunRecord read_run(const fs::path& dir) {
  RunRecord run;
  try {
    run = read_result(dir);
  } catch (const InputError& error) {
    throw std::runtime_error(error.what());
  }
  run.captures = read_rows<CaptureRow>(dir);
  run.events = read_rows<EventRow>(dir);
  run.messages = read_rows<MessageRow>(dir);
  run.poses = read_rows<PoseRow>(dir);
  run.scores = read_rows<ScoreRow>(dir);
  run.work = read_rows<WorkRow>(dir);
  run.end_s = end_of(run);
  read_incidents(run);
  return run;
}

RunRecord read_sound_run(const fs::path& dir) {
  return read_sound(dir, [](std::string_view) { return true; });
}

std::vector<std::string> damaged_files(const fs::path& dir) {
  std::vector<std::string> sentences = read_sound_run(dir).missing;
  std::erase_if(sentences, [](const std::string& sentence) { return sentence.starts_with(kThereIsNo); });
  return sentences;
}

RunRecord read_sound_files(const fs::path& dir, std::initializer_list<std::string_view> files) {
  return read_sound(dir, [&](std::string_view name) { return std::ranges::find(files, name) != files.end(); });
}

}  // namespace skein::results
