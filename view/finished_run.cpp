#include "view/finished_run.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "process/results/run_tables.hpp"
#include "process/run_folder.hpp"
#include "report/causes.hpp"
#include "report/csv_table.hpp"
#include "report/page_parts.hpp"
#include "report/recorded_links.hpp"
#include "view/story.hpp"

namespace skein::view {
namespace {

namespace fs = std::filesystem;
using report::CsvTable;
using report::RunData;

/// Rows of a table as far as they make sense: read_run_data() has told of the rest.
template <class Row>
void each_row(const fs::path& file, const Row& row) {
  try {
    for (CsvTable table(file); table.next();) row(table);
  } catch (const std::runtime_error&) {
  }
}

ShownUav pose_of(const CsvTable& table) {
  ShownUav uav;
  uav.body.p_WB = {table.number("x"), table.number("y"), table.number("z")};
  uav.body.q_WB = Quaterniond(table.number("qw"), table.number("qx"), table.number("qy"), table.number("qz"));
  uav.gimbal.pitch = table.number("gimbal_pitch");
  uav.gimbal.yaw = table.number("gimbal_yaw");
  uav.alive = table.text("alive") != "0";
  return uav;
}

/// Lines that come table by table, and are told by their times.
class Story {
 public:
  void add(double time_s, std::string line) { lines_.emplace_back(time_s, std::move(line)); }
  std::vector<std::string> in_order() {
    std::ranges::stable_sort(lines_, {}, &std::pair<double, std::string>::first);
    std::vector<std::string> lines;
    for (auto& [time_s, line] : lines_) lines.push_back(std::move(line));
    return lines;
  }

 private:
  std::vector<std::pair<double, std::string>> lines_;
};

/// The table has the fleet's poses of each time in a row. @param heights  is filled. @returns those of the end.
std::vector<ShownUav> tell_poses(const fs::path& dir, const RunData& run, Story& story, Heights& heights) {
  heights.resize(run.uavs.size());
  std::vector<ShownUav> fleet(run.uavs.size());
  std::optional<double> time_s;
  double due_s = 0.0;
  const auto tell = [&](bool last) {
    if (!time_s || (!last && *time_s < due_s)) return;
    story.add(*time_s, pose_line(*time_s, fleet));
    due_s = *time_s + kTrailPeriod_s - 1e-6;
  };
  each_row(dir / run_folder::kTrajectories, [&](const CsvTable& table) {
    const auto uav = run.uav_of(table.text("uav"));
    if (!uav) return;
    const double now_s = table.number("time_s");
    if (time_s && now_s > *time_s) tell(false);
    fleet[*uav] = pose_of(table);
    heights[*uav][now_s] = fleet[*uav].body.p_WB.z();
    time_s = now_s;
  });
  tell(true);
  return fleet;
}

/// All that is no capture: these come from captures.csv, which has more of them.
void tell_events(const RunData& run, Story& story) {
  static const std::array kToldOtherwise = {run_tables::kLinkUp, run_tables::kLinkDown, run_tables::kCaptured,
                                            run_tables::kReleased};
  for (const report::RunEvent& event : run.events) {
    if (std::ranges::find(kToldOtherwise, event.event) != kToldOtherwise.end()) continue;
    story.add(event.time_s, event_line(event.time_s, event.event, event.subject, event.object));
  }
  for (const auto& [time_s, links] : report::recorded_links(run)) story.add(time_s, links_line(time_s, links));
}

/// What UAVs did, as their programs said.
void tell_activities(const fs::path& dir, const RunData& run, Story& story) {
  each_row(dir / run_folder::kActivity, [&](const CsvTable& table) {
    const auto uav = run.uav_of(table.text("uav"));
    if (!uav) return;
    Activity activity{.mode = table.text("mode"), .waits_for = table.text("waits_for"), .no_way = table.text("no_way")};
    if (const auto x = table.number_if_any("goal_x")) {
      activity.goal_W = Vector3d(*x, table.number("goal_y"), table.number("goal_z"));
    }
    const double time_s = table.number("time_s");
    story.add(time_s, activity_line(time_s, *uav, activity));
  });
}

/// Whether a collision took the score of what this UAV had photographed.
bool is_void(const RunData& run, std::size_t uav) {
  return std::ranges::any_of(run.captures,
                             [uav](const report::RunCapture& capture) { return capture.uav == uav && capture.voided; });
}

void tell_incidents(const RunData& run, Story& story) {
  for (std::size_t i = 0; i < run.faults.size(); ++i) {
    const report::RunFault& fault = run.faults[i];
    const ToldFault told{i, fault.by_hand, fault.kind, fault.target};
    story.add(fault.from_s, fault_line(fault.from_s, told, true));
    if (fault.ended) story.add(fault.until_s, fault_line(fault.until_s, told, false));
    story.add(fault.from_s, event_line(fault.from_s, "fault", fault.kind, fault.target));
  }
  for (const report::RunCollision& collision : run.collisions) {
    story.add(collision.time_s, event_line(collision.time_s, "collision", collision.uav, collision.with));
    const auto uav = run.uav_of(collision.uav);
    if (uav && is_void(run, *uav)) story.add(collision.time_s, void_line(collision.time_s, *uav));
  }
}

/// What could be had, where it is known. Points of which it was lost that no UAV fits there are told as such.
void tell_estimate(const RunData& run, Story& story) {
  if (!run.causes_known) return;
  constexpr std::size_t kOutOfReach = *report::cause_of("out_of_reach");
  std::vector<float> q;
  std::vector<std::uint8_t> flyable;
  for (const report::RunPoint& point : run.points) {
    q.push_back(static_cast<float>(point.estimate));
    flyable.push_back(point.cause == kOutOfReach ? 0 : 1);
  }
  story.add(0.0, estimate_line(0.0, q, flyable));
}

struct TakenCapture {
  double time_s = 0.0;
  std::optional<double> delivered_s;
  std::vector<CapturePoint> points;
};

void tell_captures(const fs::path& dir, const RunData& run, Story& story) {
  std::map<std::pair<std::size_t, std::uint64_t>, TakenCapture> captures;
  each_row(dir / run_folder::kCaptures, [&](const CsvTable& table) {
    const auto uav = run.uav_of(table.text("uav"));
    if (!uav) return;
    TakenCapture& capture = captures[{*uav, table.count("capture")}];
    capture.time_s = table.number("time_s");
    capture.delivered_s = table.number_if_any("delivered_at_s");
    capture.points.push_back({static_cast<std::uint32_t>(table.count("point")),
                              static_cast<float>(table.number("q_blur")), static_cast<float>(table.number("q_res")),
                              static_cast<float>(table.number("q")), static_cast<float>(table.number("q_distance"))});
  });
  std::map<double, std::vector<ShownDelivery>> deliveries;
  for (const auto& [key, capture] : captures) {
    story.add(capture.time_s, capture_line(capture.time_s, key.first, key.second, capture.points));
    if (capture.delivered_s) deliveries[*capture.delivered_s].push_back({key.first, key.second});
  }
  for (const auto& [time_s, those] : deliveries) story.add(time_s, delivered_line(time_s, those));
}

/// The last is the result's own, with all its digits.
void tell_scores(const RunData& run, Story& story) {
  for (const report::RunScore& score : run.scores) {
    story.add(score.time_s, score_line(score.time_s, static_cast<std::size_t>(score.points), score.score));
  }
  const auto score = report::number_if_any(run.result, "score");
  const double points = report::number_in(run.result, "points_detected");
  if (score) story.add(run.end_s, score_line(run.end_s, static_cast<std::size_t>(points), *score));
}

Json scene_of(const fs::path& dir, const RunData& run) {
  std::vector<CameraConfig> cameras(run.uavs.size());
  std::vector<double> range_m(run.uavs.size(), resolution_distance(CameraConfig{}, Scenario{}.desired_mm_per_pixel));
  std::vector<std::string> missing = run.missing;
  for (std::size_t i = 0; i < run.uavs.size(); ++i) {
    if (const auto& camera = run.cameras[i]) {
      cameras[i].hfov_deg = camera->hfov_deg;
      cameras[i].vfov_deg = camera->vfov_deg;
      range_m[i] = camera->range_m;
    }
  }
  if (!std::ranges::all_of(run.cameras, [](const auto& camera) { return camera.has_value(); })) {
    missing.emplace_back("It does not tell which cameras the vehicles had: the usual one is drawn.");
  }
  if (!fs::exists(dir / run_folder::kActivity)) {
    missing.emplace_back("There is no activity.csv: what UAVs do is told from their motion.");
  }
  if (report::has_cuts(run)) {
    missing.emplace_back(
        "Whether a link that a fault covered would have been there otherwise is not recorded: it is shown as cut.");
  }
  Json scene = scene_json(run, cameras, range_m);
  scene["mode"] = "replay";
  scene["title"] = report::text_in(run.result, "scenario");
  scene["planners"] = report::planners_of(run.result);
  scene["command"] = report::command_of(run.result);
  scene["end"] = run.end_s;
  scene["status"] = report::text_in(run.result, "status");
  scene["attainable"] = value_or(run.result, "attainable", Json::object());
  scene["losses"] = value_or(run.result, "losses", nullptr);
  scene["score"] = report::number_in(run.result, "score");
  scene["detected"] = report::number_in(run.result, "points_detected");
  scene["warnings"] = value_or(run.result, "warnings", Json::array());
  scene["missing"] = missing;
  return scene;
}

}  // namespace

std::string title_of_run(const fs::path& dir) {
  const Json result = report::read_run_deliveries(dir).result;
  return report::text_in(result, "scenario") + " by " + report::planners_of(result);
}

ToldRun told_run(const fs::path& dir, const RunData& run) {
  Story story;
  Heights heights;
  std::vector<ShownUav> last = tell_poses(dir, run, story, heights);
  tell_estimate(run, story);
  tell_events(run, story);
  tell_activities(dir, run, story);
  tell_captures(dir, run, story);
  tell_incidents(run, story);
  tell_scores(run, story);
  return {scene_of(dir, run), story.in_order(), std::move(last), std::move(heights)};
}

void tell_finished_run(const fs::path& dir, Feed& feed) {
  const RunData run = report::read_run_data(dir);
  ToldRun told = told_run(dir, run);
  const KeptClouds clouds(dir, run, told.heights);
  told.scene["clouds"] = {{"lidar", clouds.lidar}, {"maps", clouds.maps}, {"missing", clouds.missing}};
  feed.set_scene(told.scene.dump(-1, ' ', false, Json::error_handler_t::replace));
  clouds.tell(told.last, feed);
  for (std::string& line : told.lines) feed.add_line(std::move(line));
}

}  // namespace skein::view
