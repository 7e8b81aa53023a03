#include "sim_server/record/run_files.hpp"

#include <spdlog/fmt/fmt.h>

#include <iterator>
#include <nlohmann/json.hpp>

#include "core/scoring/camera_quality.hpp"
#include "process/files/atomic_file.hpp"
#include "process/reports/program_report.hpp"
#include "results/run_folder.hpp"
#include "results/run_tables.hpp"
#include "sim_server/points_shown.hpp"

namespace skein::sim {
namespace {

constexpr Tick kTrajectoryPeriod = 40;  // 100 ms

/// Summary of the scenario's conditions; none in an ideal world.
Text conditions_of(const Scenario& scenario) {
  const std::string text = conditions_text(scenario.conditions);
  return text == "none" ? Text() : Text(text);
}

/// Whether a UAV was on the ground at the end because of its battery: it landed with little more than its reserve, as
/// after a timely return. A UAV that landed with more could have flown on.
bool is_grounded(const BatteryConditions& battery, const UavView& uav) {
  constexpr double kLittleMore = 0.1;
  const std::optional<double>& left = uav.battery_use.last_in_flight;
  return !uav.airborne && left && *left <= battery.reserve + kLittleMore;
}

BatteryReport battery_report(const BatteryStatus& battery, const BatteryUse& use, bool grounded) {
  return {.charge = battery.charge,
          .energy_wh = use.given_wh,
          .capacity_wh = use.capacity_wh,
          .mean_power_w = use.mean_power_w,
          .empty_s = use.empty ? Number(seconds(*use.empty)) : Number(),
          .grounded = grounded,
          .swaps = use.swaps};
}

std::vector<PoorPointReport> poor_points(const PoorPictures& pictures) {
  std::vector<PoorPointReport> reports;
  for (std::uint32_t point = 0; point < pictures.size(); ++point) {
    if (const auto best = pictures.best(point)) {
      reports.push_back({.index = point,
                         .q = Amount(best->q),
                         .q_blur = Amount(best->q_blur),
                         .q_distance = Amount(best->q_distance),
                         .q_res = Amount(best->q_res)});
    }
  }
  return reports;
}

nlohmann::json vector_json(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

std::string collided_with(const Collision& collision, const Scenario& scenario) {
  switch (collision.with.kind) {
    case BodyId::Kind::ground:
      return "ground";
    case BodyId::Kind::structure:
      return "structure";
    case BodyId::Kind::uav:
      return scenario.fleet[collision.with.uav].name;
  }
  return "structure";
}

std::string describe(const Collision& collision, const Scenario& scenario) {
  const Vector3d& p = collision.p_W;
  return fmt::format("{} {} {} at {:.4f} s, at ({:.2f}, {:.2f}, {:.2f}): it is out", scenario.fleet[collision.uav].name,
                     collision.battery_empty ? "fell with an empty battery, and hit" : "collided with",
                     collided_with(collision, scenario), seconds(collision.tick), p.x(), p.y(), p.z());
}

std::string describe(const Stray& stray, const Scenario& scenario) {
  const Vector3d& p = stray.p_W;
  return fmt::format(
      "{} left the world at {:.4f} s, or its motion was no longer finite; last seen at "
      "({:.2f}, {:.2f}, {:.2f}): it is out",
      scenario.fleet[stray.uav].name, seconds(stray.tick), p.x(), p.y(), p.z());
}

RunFiles::RunFiles(const std::filesystem::path& folder, const Scenario& scenario, const RunDigest& digest,
                   FlightReport flight)
    : folder_(folder),
      flight_(std::move(flight)),
      scenario_(scenario),
      trajectories_(folder / run_folder::kTrajectories),
      digests_(folder / run_folder::kDigests),
      events_(folder, scenario),
      activities_(folder, scenario),
      review_(scenario) {
  trajectories_ << run_tables::kPoseColumns << run_tables::kMotionColumns
                << (scenario.conditions.battery.on() ? run_tables::kChargeColumn : "") << "\n";
  digests_ << "k,digest";
  for (const std::string& column : digest.columns()) digests_ << "," << column;
  digests_ << "\n";
  trajectories_.flush();  // see event_log.cpp
  digests_.flush();
}

void RunFiles::write_scene(const Scene& scene) {
  if (!digests_.kept()) return;
  nlohmann::json json;
  json["boxes"] = nlohmann::json::array();
  for (const OrientedBox& box : scene.boxes) {
    nlohmann::json rotation = nlohmann::json::array();
    for (int row = 0; row < 3; ++row) rotation.push_back(vector_json(box.R_WO.row(row)));
    json["boxes"].push_back({{"name", box.name},
                             {"center", vector_json(box.center)},
                             {"size", vector_json(box.size)},
                             {"rotation", rotation}});
  }
  nlohmann::json meshes = nlohmann::json::array();
  for (const auto& mesh : scenario_.scene.meshes) meshes.push_back(mesh.filename().string());
  json["mesh"] = {{"family", scenario_.scene.family},
                  {"scene_seed", scenario_.scene.scene_seed},
                  {"files", meshes},
                  {"triangles", scene.mesh.triangles.size()}};
  json["cameras"] = nlohmann::json::array();
  for (const UavConfig& uav : scenario_.fleet) {
    const CameraConfig& camera = uav.vehicle.camera;
    json["cameras"].push_back({{"uav", uav.name},
                               {"hfov_deg", camera.hfov_deg},
                               {"vfov_deg", camera.vfov_deg},
                               {"range_m", resolution_distance(camera, scenario_.desired_mm_per_pixel)}});
  }
  json["points"] = nlohmann::json::array();
  for (const InterestPoint& point : scene.points) {
    json["points"].push_back(
        {point.p_W.x(), point.p_W.y(), point.p_W.z(), point.n_W.x(), point.n_W.y(), point.n_W.z()});
  }
  note_unwritten(write_if_possible(folder_ / run_folder::kScene, json.dump()));
}

void RunFiles::note_unwritten(std::string trouble) {
  if (!trouble.empty()) unwritten_.push_back(std::move(trouble));
}

void RunFiles::add_step(const Simulation& simulation, const StepDigest& digest) {
  if (!digests_.kept()) return;
  digests_ << std::to_string(digest.k) << "," << digest.running;
  for (const std::string& field : digest.fields) digests_ << "," << field;
  digests_ << "\n";
  review_.add_step(simulation);
  if (simulation.tick() % kTrajectoryPeriod != 0) return;
  fmt::memory_buffer line;
  for (const UavIndex i : FirstUavs(simulation.size())) {
    const UavView& uav = simulation.uav(i);
    const auto& [p, q, v, w] = uav.state;
    fmt::format_to(
        std::back_inserter(line),
        "{:.2f},{},{:.4f},{:.4f},{:.4f},{:.5f},{:.5f},{:.5f},{:.5f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{},{:.3f}",
        seconds(simulation.tick()), scenario_.fleet[i].name, p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z(), v.x(),
        v.y(), v.z(), uav.gimbal.pitch, uav.gimbal.yaw, uav.alive ? 1 : 0, simulation.clearance(i));
    if (uav.battery) fmt::format_to(std::back_inserter(line), ",{:.4f}", uav.battery->charge);
    line.push_back('\n');
  }
  trajectories_ << std::string_view(line.data(), line.size());
}

std::vector<UavReport> RunFiles::uav_reports(const Simulation& simulation, const RunSummary& summary) const {
  std::vector<UavReport> reports;
  for (const UavIndex i : FirstUavs(simulation.size())) {
    const UavView& uav = simulation.uav(i);
    const UavConfig& config = scenario_.fleet[i];
    reports.push_back({.name = config.name,
                       .role = config.vehicle.role,
                       .alive = uav.alive,
                       .distance_m = uav.distance_m,
                       .max_speed_mps = uav.max_speed_mps,
                       .captures = uav.captures,
                       .idle_s = uav.idle_s,
                       .commands_rejected = uav.commands_rejected,
                       .first_rejected_s = uav.first_rejected ? Number(seconds(*uav.first_rejected)) : Number(),
                       .commands_unheard = i < summary.commands_unheard.size() ? summary.commands_unheard[i] : 0});
    if (uav.battery)
      reports.back().battery =
          battery_report(*uav.battery, uav.battery_use, is_grounded(scenario_.conditions.battery, uav));
    if (i < summary.work.size()) {
      const WorkTrack& work = summary.work[i];
      reports.back().work = WorkReport{work.open, std::vector<Amount>(work.done.begin(), work.done.end())};
    }
  }
  return reports;
}

SimServerReport RunFiles::report(const Simulation& simulation, const RunSummary& summary) const {
  const Mission& mission = simulation.mission();
  SimServerReport report{.status = summary.status,
                         .deterministic = summary.deterministic,
                         .digest = summary.digest,
                         .sim_time_s = seconds(simulation.tick()),
                         .mission_time_s = 0.0,
                         .wall_time_s = summary.wall_time_s,
                         .rules = scenario_.rules.preset,
                         .conditions = conditions_of(scenario_),
                         .points_total = simulation.scene().points.size(),
                         .points_seen = std::string(),
                         .uavs = uav_reports(simulation, summary),
                         .faults = summary.faults,
                         .hand = summary.hand,
                         .timing = summary.timing,
                         .flight = flight_,
                         .flight_check = review_.report(),
                         .warnings = summary.warnings,
                         .malformed = summary.malformed,
                         .unsent = summary.unsent,
                         .unwritten = unwritten_,
                         .differences = summary.differences};
  if (mission.start_tick()) {
    report.mission_time_s = seconds(mission.end_tick().value_or(simulation.tick()) - *mission.start_tick());
  }
  const PointsShown shown = points_shown(simulation);
  for (const bool flag : shown.seen) *report.points_seen += flag ? '1' : '0';
  if (!shown.if_exact.empty()) report.points_if_exact.emplace(shown.if_exact.begin(), shown.if_exact.end());
  if (!shown.if_calm.empty()) report.points_if_calm.emplace(shown.if_calm.begin(), shown.if_calm.end());
  report.points_poor = poor_points(simulation.referee().poor_pictures());
  for (const Collision& c : summary.collisions) {
    report.collisions.push_back({.time_s = seconds(c.tick),
                                 .uav = scenario_.fleet[c.uav].name,
                                 .with = collided_with(c, scenario_),
                                 .cause = c.battery_empty ? Text("battery") : Text(),
                                 .position = {{c.p_W.x(), c.p_W.y(), c.p_W.z()}}});
  }
  for (const LostProcess& lost : summary.lost) {
    report.lost_members.push_back(
        {.member = lost.name, .step = lost.step, .time_s = seconds(lost.tick), .reason = lost.reason});
    if (lost.back) report.lost_members.back().back_at_s = seconds(*lost.back);
  }
  return report;
}

void RunFiles::write_report(const Simulation& simulation, const RunSummary& summary, StatusPipe& status) {
  for (StreamFile* file : {&trajectories_, &digests_, &events_.file(), &activities_.file()}) {
    file->flush();
    if (!file->write_error().empty()) unwritten_.push_back(file->write_error());
  }
  note_unwritten(write_if_possible(folder_ / run_folder::kTracking, review_.tracking_csv()));
  hand_in_report(json_of(report(simulation, summary)), folder_ / run_folder::report_file(programs::kSimServer), status);
}

}  // namespace skein::sim
