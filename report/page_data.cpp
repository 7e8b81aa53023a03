#include "report/page_data.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "report/recorded_links.hpp"

namespace skein::report {
namespace {

constexpr double kEachS = 0.5;                ///< time between two positions of a track
constexpr std::size_t kMostPoses = 120'000;   ///< in all tracks together; beyond it, tracks are thinned further
constexpr std::size_t kMostChanges = 6000;    ///< changes of the score in a curve; beyond it, curves are thinned
constexpr std::size_t kMostWaiting = 40'000;  ///< changes of numbers of undelivered captures, all UAVs together

long centimetres(double metres) { return std::lround(100.0 * metres); }
double rounded(double value, double by) { return std::round(value / by) * by; }

Json in_cm(const Vector3d& p_W) {
  return Json::array({centimetres(p_W.x()), centimetres(p_W.y()), centimetres(p_W.z())});
}

long milliradians(double angle) { return std::isfinite(angle) ? std::lround(1e3 * angle) : 0; }

/// Times in hundredths of a second, positions in cm, camera angles in mrad. Each number is the difference from the
/// previous one, which keeps the text short.
Json track_json(const std::vector<const results::PoseRow*>& track, double each_s) {
  static constexpr std::array kColumns = {"t", "x", "y", "z", "yaw", "pitch"};
  std::array<Json, kColumns.size()> columns;
  columns.fill(Json::array());
  std::array<long, kColumns.size()> last{};
  double next_s = -1e9;
  for (std::size_t i = 0; i < track.size(); ++i) {
    const results::PoseRow& pose = *track[i];
    if (pose.time_s < next_s && i + 1 < track.size()) continue;
    next_s = pose.time_s + each_s - 1e-6;
    const results::ViewAngles view = results::view_angles(pose.q_WB, pose.gimbal);
    const std::array<long, kColumns.size()> now = {std::lround(100.0 * pose.time_s), centimetres(pose.p_W.x()),
                                                   centimetres(pose.p_W.y()),        centimetres(pose.p_W.z()),
                                                   milliradians(view.yaw),           milliradians(view.pitch)};
    for (std::size_t k = 0; k < now.size(); ++k) {
      columns[k].push_back(now[k] - last[k]);
      last[k] = now[k];
    }
  }
  Json json = Json::object();
  for (std::size_t k = 0; k < columns.size(); ++k) json[kColumns[k]] = std::move(columns[k]);
  return json;
}

/// Times in ms, scores in thousandths.
Json curve_json(const std::vector<results::ScoreRow>& scores) {
  Json t = Json::array(), v = Json::array();
  const std::size_t step = scores.size() / kMostChanges + 1;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    if (i % step != 0 && i + 1 < scores.size()) continue;
    t.push_back(std::lround(1e3 * scores[i].time_s));
    v.push_back(std::lround(1e3 * scores[i].score));
  }
  return {{"t", std::move(t)}, {"v", std::move(v)}};
}

Json spans_json(const Spans& spans) {
  Json flat = Json::array();
  for (const Span& span : spans) {
    flat.push_back(rounded(span.from_s, 0.01));
    flat.push_back(rounded(span.until_s, 0.01));
  }
  return flat;
}

/// A flat array with nine numbers per point: x, y, z in cm, the normal's x, y, z in hundredths, score and estimate in
/// thousandths, cause (-1: none).
Json points_json(const results::RunRecord& run) {
  Json flat = Json::array();
  for (const results::RunPoint& point : run.points) {
    for (const long value : {centimetres(point.p_W.x()), centimetres(point.p_W.y()), centimetres(point.p_W.z()),
                             centimetres(point.normal_W.x()), centimetres(point.normal_W.y()),
                             centimetres(point.normal_W.z()), std::lround(1e3 * point.score),
                             std::lround(1e3 * point.estimate), point.cause ? static_cast<long>(*point.cause) : -1L}) {
      flat.push_back(value);
    }
  }
  return flat;
}

/// A flat array with two numbers per point: the UAV whose capture determines the score (-1: none), and the capture's
/// time in ms. It is the best delivered capture; of equally good ones the earliest.
Json best_json(const results::RunRecord& run) {
  std::vector<const results::CaptureRow*> best(run.points.size(), nullptr);
  for (const results::CaptureRow& capture : run.captures) {
    if (!capture.delivered_at_s || capture.voided() || capture.point >= best.size() || capture.q < kDetected) continue;
    const results::CaptureRow*& now = best[capture.point];
    if (now == nullptr || capture.q > now->q || (capture.q == now->q && capture.time_s < now->time_s)) now = &capture;
  }
  Json flat = Json::array();
  for (const results::CaptureRow* capture : best) {
    const auto uav = capture != nullptr ? run.uav_of(capture->uav) : std::nullopt;
    flat.push_back(uav ? static_cast<int>(*uav) : -1);
    flat.push_back(capture != nullptr ? std::lround(1e3 * capture->time_s) : 0L);
  }
  return flat;
}

/// Times in ms. If there are more than `most` changes, successive ones are merged, with their greatest number.
Json waiting_json(const std::vector<Waiting>& changes, std::size_t most) {
  Json t = Json::array(), v = Json::array();
  const std::size_t step = changes.size() / most + 1;
  for (std::size_t i = 0; i < changes.size(); i += step) {
    int captures = 0;
    for (std::size_t j = i; j < std::min(i + step, changes.size()); ++j) {
      captures = std::max(captures, changes[j].captures);
    }
    t.push_back(std::lround(1e3 * changes[i].time_s));
    v.push_back(captures);
  }
  return {{"t", std::move(t)}, {"v", std::move(v)}};
}

/// `l`: the states of all links as digits of LinkState, valid from the times `t` [ms] on. Null for a large fleet, where
/// they would be most of the page.
Json links_json(const results::RunRecord& run) {
  constexpr std::size_t kMostDigits = 600'000;  // about as many bytes of the page
  Json t = Json::array(), l = Json::array();
  const auto links = recorded_links(run);
  const std::size_t nodes = run.uavs.size() + 1;
  if (links.size() * nodes * nodes > kMostDigits) return nullptr;
  for (const auto& [time_s, states] : links) {
    t.push_back(std::lround(1e3 * time_s));
    l.push_back(digits_of(states));
  }
  return {{"t", std::move(t)}, {"l", std::move(l)}};
}

/// Field of view [deg] and useful range [m] of a camera; null if the run's files do not contain them.
Json camera_json(const std::optional<results::RunCamera>& camera) {
  if (!camera) return nullptr;
  return {{"hfov", camera->hfov_deg}, {"vfov", camera->vfov_deg}, {"range", camera->range_m}};
}

/// For each second of the run, the number of entries of `times_s` within it.
Json each_second(const std::vector<double>& times_s, double end_s) {
  std::vector<int> counts(static_cast<std::size_t>(std::min(std::max(end_s, 0.0), 1e5)) + 1, 0);
  for (const double time_s : times_s) {
    const auto second = static_cast<std::size_t>(std::max(time_s, 0.0));
    if (second < counts.size()) ++counts[second];
  }
  return counts;
}

}  // namespace

Json page_data(const RunPage& page) {
  const results::RunRecord& run = page.run;
  const auto tracks = run.by_uav(run.poses);
  std::size_t poses = 0;
  for (const auto& track : tracks) poses += track.empty() ? 0 : static_cast<std::size_t>(run.end_s / kEachS);
  const double each_s = kEachS * std::max(1.0, std::ceil(static_cast<double>(poses) / kMostPoses));
  Json data = {{"end", run.end_s}, {"delivered", curve_json(run.scores)}, {"earned", curve_json(page.earned)}};
  data["uavs"] = Json::array();
  for (std::size_t uav = 0; uav < run.uavs.size(); ++uav) {
    const Lane& lane = page.lanes[uav];
    data["uavs"].push_back({{"name", run.uavs[uav]},
                            {"explorer", static_cast<bool>(run.explorer[uav])},
                            {"track", track_json(tracks[uav], each_s)},
                            {"camera", uav < run.cameras.size() ? camera_json(run.cameras[uav]) : Json()},
                            {"captures", each_second(lane.captures_s, run.end_s)},
                            {"waiting", waiting_json(lane.undelivered, kMostWaiting / run.uavs.size() + 1)},
                            {"still", spans_json(lane.still)},
                            {"direct", spans_json(lane.direct)},
                            {"relayed", spans_json(lane.relayed)},
                            {"collided", lane.collided_s ? Json(*lane.collided_s) : Json()}});
  }
  data["best"] = best_json(run);
  data["links"] = links_json(run);
  data.update(scene_data(run));
  return data;
}

Json scene_data(const results::RunRecord& run) {
  Json data = Json::object();
  data["points"] = points_json(run);
  data["causes"] = Json::array();
  data["cause_keys"] = Json::array();
  for (const results::Cause& cause : results::kCauses) {
    data["causes"].push_back(std::string(cause.title));
    data["cause_keys"].push_back(std::string(cause.key));
  }
  data["causes_known"] = run.causes_known;
  data["boxes"] = Json::array();
  for (const results::RunBox& box : run.boxes) {
    Json corners = Json::array();
    for (const Vector3d& corner : corners_of(box.center, box.size, box.R_WB)) corners.push_back(in_cm(corner));
    data["boxes"].push_back(std::move(corners));
  }
  data["station"] = run.station ? in_cm(*run.station) : Json();
  data["collisions"] = Json::array();
  for (const results::RunCollision& collision : run.collisions) {
    if (collision.p_W) data["collisions"].push_back(in_cm(*collision.p_W));
  }
  data["faults"] = Json::array();
  for (const results::RunFault& fault : run.faults) {
    data["faults"].push_back(
        {{"name", fault.kind + " " + fault.target}, {"from", fault.from_s}, {"until", fault.until_s}});
  }
  return data;
}

}  // namespace skein::report
