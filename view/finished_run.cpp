#include "view/finished_run.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "process/run_folder.hpp"
#include "process/run_tables.hpp"
#include "report/csv_table.hpp"
#include "report/page_parts.hpp"
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
  void tell(Feed& feed) {
    std::ranges::stable_sort(lines_, {}, &std::pair<double, std::string>::first);
    for (auto& [time_s, line] : lines_) feed.add_line(std::move(line));
  }

 private:
  std::vector<std::pair<double, std::string>> lines_;
};

/// The table has the fleet's poses of each time in a row.
void tell_poses(const fs::path& dir, const RunData& run, Story& story) {
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
    time_s = now_s;
  });
  tell(true);
}

/// Links and all that is no capture: these come from captures.csv, which has more of them.
void tell_events(const RunData& run, Story& story) {
  const std::size_t nodes = run.uavs.size() + 1;
  std::vector<ShownLink> links(nodes * nodes, ShownLink::blocked);
  const auto node_of = [&](const std::string& name) -> std::size_t {
    const auto uav = run.uav_of(name);
    return uav ? *uav + 1 : 0;
  };
  bool stale = false;
  for (std::size_t i = 0; i < run.events.size(); ++i) {
    const report::RunEvent& event = run.events[i];
    const bool up = event.event == run_tables::kLinkUp;
    if (up || event.event == run_tables::kLinkDown) {
      links[node_of(event.subject) * nodes + node_of(event.object)] = up ? ShownLink::linked : ShownLink::blocked;
      stale = true;
    } else if (event.event != run_tables::kCaptured && event.event != run_tables::kReleased) {
      story.add(event.time_s, event_line(event.time_s, event.event, event.subject, event.object));
    }
    const bool last_of_step = i + 1 == run.events.size() || run.events[i + 1].time_s > event.time_s;
    if (stale && last_of_step) story.add(event.time_s, links_line(event.time_s, links));
    stale = stale && !last_of_step;
  }
}

/// Whether a collision took the score of what this UAV had photographed.
bool is_void(const RunData& run, std::size_t uav) {
  return std::ranges::any_of(run.captures,
                             [uav](const report::RunCapture& capture) { return capture.uav == uav && capture.voided; });
}

void tell_incidents(const RunData& run, Story& story) {
  for (const report::RunFault& fault : run.faults) {
    story.add(fault.from_s, event_line(fault.from_s, "fault", fault.kind, fault.target));
  }
  for (const report::RunCollision& collision : run.collisions) {
    story.add(collision.time_s, event_line(collision.time_s, "collision", collision.uav, collision.with));
    const auto uav = run.uav_of(collision.uav);
    if (uav && is_void(run, *uav)) story.add(collision.time_s, void_line(collision.time_s, *uav));
  }
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
  for (const auto& [key, capture] : captures) {
    story.add(capture.time_s, capture_line(capture.time_s, key.first, key.second, capture.points));
    if (capture.delivered_s)
      story.add(*capture.delivered_s, delivered_line(*capture.delivered_s, key.first, key.second));
  }
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

Json scene_of(const RunData& run) {
  // A results folder does not tell of cameras: this is the usual one.
  const std::vector<CameraConfig> cameras(run.uavs.size());
  const double range_m = resolution_distance(CameraConfig{}, Scenario{}.desired_mm_per_pixel);
  Json scene = scene_json(run, cameras, std::vector<double>(run.uavs.size(), range_m));
  scene["mode"] = "replay";
  scene["title"] = report::text_in(run.result, "scenario");
  scene["planners"] = report::planners_of(run.result);
  scene["command"] = report::command_of(run.result);
  scene["end"] = run.end_s;
  scene["status"] = report::text_in(run.result, "status");
  scene["attainable"] = value_or(run.result, "attainable", Json::object());
  scene["warnings"] = value_or(run.result, "warnings", Json::array());
  scene["missing"] = run.missing;
  return scene;
}

}  // namespace

std::string title_of_run(const fs::path& dir) {
  const Json result = report::read_run_deliveries(dir).result;
  return report::text_in(result, "scenario") + " by " + report::planners_of(result);
}

void tell_finished_run(const fs::path& dir, Feed& feed) {
  const RunData run = report::read_run_data(dir);
  feed.set_scene(scene_of(run).dump(-1, ' ', false, Json::error_handler_t::replace));
  Story story;
  tell_poses(dir, run, story);
  tell_events(run, story);
  tell_captures(dir, run, story);
  tell_incidents(run, story);
  tell_scores(run, story);
  story.tell(feed);
}

}  // namespace skein::view
