#include "view/finished_run.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "report/page_parts.hpp"
#include "report/recorded_links.hpp"
#include "results/causes.hpp"
#include "results/result_file.hpp"
#include "results/run_folder.hpp"
#include "results/run_tables.hpp"
#include "view/story.hpp"

namespace skein::view {
namespace {

namespace fs = std::filesystem;
using results::RunRecord;

ShownUav pose_of(const results::PoseRow& row) {
  ShownUav uav;
  uav.body.p_WB = row.p_W;
  uav.body.q_WB = row.q_WB;
  uav.gimbal = row.gimbal;
  uav.alive = row.alive;
  return uav;
}

/// Collects lines table by table, and returns them in order of time.
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

/// Adds the fleet's poses. In the table, the rows of one time are adjacent. @param heights  is filled.
/// @returns the last poses.
std::vector<ShownUav> tell_poses(const RunRecord& run, Story& story, Heights& heights) {
  heights.resize(run.uavs.size());
  std::vector<ShownUav> fleet(run.uavs.size());
  std::optional<double> time_s;
  double due_s = 0.0;
  const auto tell = [&](bool last) {
    if (!time_s || (!last && *time_s < due_s)) return;
    story.add(*time_s, pose_line(*time_s, fleet));
    due_s = *time_s + kTrailPeriod_s - 1e-6;
  };
  for (const results::PoseRow& row : run.poses) {
    const auto uav = run.uav_of(row.uav);
    if (!uav) continue;
    if (time_s && row.time_s > *time_s) tell(false);
    fleet[*uav] = pose_of(row);
    heights[*uav][row.time_s] = row.p_W.z();
    time_s = row.time_s;
  }
  tell(true);
  return fleet;
}

/// Adds all events but captures, which come from captures.csv: that table has more details.
void tell_events(const RunRecord& run, Story& story) {
  static const std::array kToldOtherwise = {run_tables::kLinkUp, run_tables::kLinkDown, run_tables::kCaptured,
                                            run_tables::kReleased};
  for (const results::EventRow& event : run.events) {
    if (std::ranges::find(kToldOtherwise, event.event) != kToldOtherwise.end()) continue;
    story.add(event.time_s, event_line(event.time_s, event.event, event.subject, event.object));
  }
  for (const auto& [time_s, links] : report::recorded_links(run)) story.add(time_s, links_line(time_s, links));
}

/// Adds the activities that the UAVs' programs reported.
void tell_activities(const RunRecord& run, Story& story) {
  for (const results::ActivityRow& row : run.activities) {
    const auto uav = run.uav_of(row.uav);
    if (uav) story.add(row.time_s, activity_line(row.time_s, *uav, row.activity));
  }
}

/// Whether a collision voided this UAV's captures.
bool is_void(const RunRecord& run, const std::string& uav) {
  return std::ranges::any_of(run.captures,
                             [&](const results::CaptureRow& row) { return row.uav == uav && row.voided(); });
}

void tell_incidents(const RunRecord& run, Story& story) {
  for (std::size_t i = 0; i < run.faults.size(); ++i) {
    const results::RunFault& fault = run.faults[i];
    const ToldFault told{i, fault.by_hand, fault.kind, fault.target};
    story.add(fault.from_s, fault_line(fault.from_s, told, true));
    if (fault.ended) story.add(fault.until_s, fault_line(fault.until_s, told, false));
    story.add(fault.from_s, event_line(fault.from_s, "fault", fault.kind, fault.target));
  }
  for (const results::RunCollision& collision : run.collisions) {
    story.add(collision.time_s, event_line(collision.time_s, "collision", collision.uav, collision.with));
    const auto uav = run.uav_of(collision.uav);
    if (uav && is_void(run, collision.uav)) story.add(collision.time_s, void_line(collision.time_s, *uav));
  }
}

/// Adds the attainable quality, if it is known. Points with the cause "out_of_reach" are marked as not flyable.
void tell_estimate(const RunRecord& run, Story& story) {
  if (!run.causes_known) return;
  constexpr std::size_t kOutOfReach = *results::cause_of("out_of_reach");
  std::vector<float> q;
  std::vector<std::uint8_t> flyable;
  for (const results::RunPoint& point : run.points) {
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

void tell_captures(const RunRecord& run, Story& story) {
  std::map<std::pair<std::size_t, std::uint64_t>, TakenCapture> captures;
  for (const results::CaptureRow& row : run.captures) {
    const auto uav = run.uav_of(row.uav);
    if (!uav) continue;
    TakenCapture& capture = captures[{*uav, row.capture}];
    capture.time_s = row.time_s;
    capture.delivered_s = row.delivered_at_s;
    capture.points.push_back({static_cast<std::uint32_t>(row.point), static_cast<float>(row.q_blur),
                              static_cast<float>(row.q_res), static_cast<float>(row.q),
                              static_cast<float>(row.q_distance)});
  }
  std::map<double, std::vector<ShownDelivery>> deliveries;
  for (const auto& [key, capture] : captures) {
    story.add(capture.time_s, capture_line(capture.time_s, key.first, key.second, capture.points));
    if (capture.delivered_s) deliveries[*capture.delivered_s].push_back({key.first, key.second});
  }
  for (const auto& [time_s, those] : deliveries) story.add(time_s, delivered_line(time_s, those));
}

/// Adds the scores. The last line has the score of the result, with all its digits.
void tell_scores(const RunRecord& run, Story& story) {
  for (const results::ScoreRow& score : run.scores) {
    story.add(score.time_s, score_line(score.time_s, static_cast<std::size_t>(score.points), score.score));
  }
  const auto score = number_if_any(run.result, "score");
  const double points = number_in(run.result, "points_detected");
  if (score) story.add(run.end_s, score_line(run.end_s, static_cast<std::size_t>(points), *score));
}

Json scene_of(const RunRecord& run) {
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
    missing.emplace_back(
        "The recorded scene does not name the vehicles' cameras, so the page draws the default camera.");
  }
  if (!fs::exists(run.dir / run_folder::kActivity)) {
    missing.emplace_back("There is no activity.csv: the page derives what UAVs do from their motion.");
  }
  if (report::has_cuts(run)) {
    missing.emplace_back(
        "Whether a link that a fault covered would have been there otherwise is not recorded: it is shown as cut.");
  }
  Json scene = scene_json(run, cameras, range_m);
  scene["mode"] = "replay";
  scene["title"] = text_in(run.result, "scenario");
  scene["planners"] = report::planners_of(run.result);
  scene["command"] = report::command_of(run.result);
  scene["end"] = run.end_s;
  scene["status"] = text_in(run.result, "status");
  scene["attainable"] = value_or(run.result, "attainable", Json::object());
  scene["losses"] = value_or(run.result, "losses", nullptr);
  scene["score"] = number_in(run.result, "score");
  scene["detected"] = number_in(run.result, "points_detected");
  scene["warnings"] = value_or(run.result, "warnings", Json::array());
  scene["missing"] = missing;
  return scene;
}

}  // namespace

std::string title_of_run(const fs::path& dir) {
  const Json result = results::read_result_file(dir);
  return text_in(result, "scenario") + " by " + report::planners_of(result);
}

ToldRun told_run(const RunRecord& run) {
  Story story;
  Heights heights;
  std::vector<ShownUav> last = tell_poses(run, story, heights);
  tell_estimate(run, story);
  tell_events(run, story);
  tell_activities(run, story);
  tell_captures(run, story);
  tell_incidents(run, story);
  tell_scores(run, story);
  return {scene_of(run), story.in_order(), std::move(last), std::move(heights)};
}

void tell_finished_run(const fs::path& dir, Feed& feed) {
  const RunRecord run = results::read_sound_run(dir);
  ToldRun told = told_run(run);
  const KeptClouds clouds(dir, run, told.heights);
  told.scene["clouds"] = {{"lidar", clouds.lidar}, {"maps", clouds.maps}, {"missing", clouds.missing}};
  feed.set_scene(told.scene.dump(-1, ' ', false, Json::error_handler_t::replace));
  clouds.tell(told.last, feed);
  for (std::string& line : told.lines) feed.add_line(std::move(line));
}

}  // namespace skein::view
