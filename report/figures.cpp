#include "report/figures.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "results/run_tables.hpp"

namespace skein::report {
namespace {

constexpr double kStillMps = 0.1, kIdleAfterS = 5.0;  // as for sim_server's idle_s
constexpr const char* kStationNode = "gcs";

void add_point(const results::RunPoint& point, BoxFigures& box) {
  ++box.points;
  box.attainable += point.estimate > 0.0 ? 1 : 0;
  box.scored += point.score > 0.0 ? 1 : 0;
  box.estimate += point.estimate;
  box.score += point.score;
  if (point.cause) box.losses[*point.cause] += point.loss;
}

/// Appends a span, or extends the last one if both touch. An empty span is ignored.
void add_span(Spans& spans, double from_s, double until_s) {
  if (!(until_s > from_s)) return;
  if (!spans.empty() && spans.back().until_s >= from_s) {
    spans.back().until_s = std::max(spans.back().until_s, until_s);
  } else {
    spans.push_back({from_s, until_s});
  }
}

/// The open links at one time, and which UAVs reach the station over them.
class Mesh {
 public:
  explicit Mesh(const results::RunRecord& run) : uavs_(run.uavs.size()), run_(run) {
    hears_.assign(uavs_ + 1, std::vector<bool>(uavs_ + 1, false));
  }

  void set(const results::EventRow& event) {
    const auto from = node_of(event.subject), to = node_of(event.object);
    if (from && to) hears_[*to][*from] = event.event == run_tables::kLinkUp;
  }
  /// Adds a span to the lane of each UAV that reaches the station over the present links.
  void account(double from_s, double until_s, std::vector<Lane>& lanes) const {
    std::vector<bool> reached(uavs_ + 1, false);
    std::vector<std::size_t> open = {uavs_};
    reached[uavs_] = true;
    while (!open.empty()) {
      const std::size_t node = open.back();
      open.pop_back();
      for (std::size_t other = 0; other < uavs_; ++other) {
        if (reached[other] || !hears_[node][other]) continue;
        reached[other] = true;
        open.push_back(other);
      }
    }
    for (std::size_t uav = 0; uav < uavs_; ++uav) {
      if (reached[uav]) add_span(hears_[uavs_][uav] ? lanes[uav].direct : lanes[uav].relayed, from_s, until_s);
    }
  }

 private:
  std::optional<std::size_t> node_of(const std::string& name) const {
    return name == kStationNode ? std::optional(uavs_) : run_.uav_of(name);
  }

  std::size_t uavs_;  ///< number of UAVs, which is also the index of the station's node
  const results::RunRecord& run_;
  std::vector<std::vector<bool>> hears_;  ///< by receiver and sender
};

void add_links(const results::RunRecord& run, std::vector<Lane>& lanes) {
  Mesh mesh(run);
  double since_s = 0.0;
  for (const results::EventRow& event : run.events) {
    if (!event.is_of_a_link()) continue;
    if (event.time_s > since_s) mesh.account(since_s, event.time_s, lanes);
    since_s = event.time_s;
    mesh.set(event);
  }
  if (!run.events.empty()) mesh.account(since_s, run.end_s, lanes);
}

/// Adds to each UAV's lane the spans in which its program took part in the run, and the number of captures that waited
/// for acknowledgement.
void add_members(const results::RunRecord& run, std::vector<Lane>& lanes) {
  std::vector<std::optional<double>> joined(run.uavs.size());
  std::vector<int> waiting(run.uavs.size(), 0);
  for (const results::EventRow& event : run.events) {
    const auto uav = event.is_of_a_link() ? std::nullopt : run.uav_of(event.subject);
    if (!uav) continue;
    Lane& lane = lanes[*uav];
    const auto count = [&](int more) {
      waiting[*uav] = std::max(0, waiting[*uav] + more);
      if (!lane.undelivered.empty() && lane.undelivered.back().time_s == event.time_s) {
        lane.undelivered.back().captures = waiting[*uav];
      } else {
        lane.undelivered.push_back({event.time_s, waiting[*uav]});
      }
    };
    if (event.event == run_tables::kCaptured) count(1);
    if (event.event == run_tables::kReleased) count(-1);
    if (event.event == run_tables::kJoined) joined[*uav] = event.time_s;
    if (event.event == run_tables::kLeft && joined[*uav]) {
      add_span(lane.taking_part, *joined[*uav], event.time_s);
      joined[*uav].reset();
    }
  }
  for (std::size_t uav = 0; uav < lanes.size(); ++uav) {
    if (joined[uav]) add_span(lanes[uav].taking_part, *joined[uav], run.end_s);
  }
}

/// One entry per capture, with its time and its delivery, by UAV and number of the capture.
std::map<std::pair<std::size_t, std::uint64_t>, results::CaptureRow> whole_captures(const results::RunRecord& run) {
  std::map<std::pair<std::size_t, std::uint64_t>, results::CaptureRow> captures;
  for (const results::CaptureRow& line : run.captures) {
    const auto uav = run.uav_of(line.uav);
    if (!uav) continue;
    results::CaptureRow& capture = captures.try_emplace({*uav, line.capture}, line).first->second;
    if (!capture.delivered_at_s) capture.delivered_at_s = line.delivered_at_s;
  }
  return captures;
}

Spans still_spans(const std::vector<const results::PoseRow*>& track, const std::vector<double>& captures_s) {
  Spans still;
  auto next = captures_s.begin();
  double last_capture_s = -kIdleAfterS;
  for (std::size_t i = 0; i + 1 < track.size(); ++i) {
    const results::PoseRow& pose = *track[i];
    for (; next != captures_s.end() && *next <= pose.time_s; ++next) last_capture_s = *next;
    const bool waits = pose.alive && pose.v_W.norm() < kStillMps && pose.time_s - last_capture_s >= kIdleAfterS;
    if (waits) add_span(still, pose.time_s, track[i + 1]->time_s);
  }
  return still;
}

}  // namespace

std::vector<BoxFigures> box_figures(const results::RunRecord& run) {
  std::vector<BoxFigures> rows;
  for (const results::RunBox& box : run.boxes) rows.push_back({box.name, 0, 0, 0, 0.0, 0.0, {}});
  BoxFigures outside{"outside all boxes", 0, 0, 0, 0.0, 0.0, {}}, all{"all", 0, 0, 0, 0.0, 0.0, {}};
  for (const results::RunPoint& point : run.points) {
    const auto holds = [&](const results::RunBox& box) { return box.holds(point.p_W); };
    const auto found = std::find_if(run.boxes.begin(), run.boxes.end(), holds);
    add_point(point, found == run.boxes.end() ? outside : rows[static_cast<std::size_t>(found - run.boxes.begin())]);
    add_point(point, all);
  }
  if (outside.points > 0) rows.push_back(std::move(outside));
  rows.push_back(std::move(all));
  return rows;
}

double length_of(const Spans& spans) {
  double sum = 0.0;
  for (const Span& span : spans) sum += span.until_s - span.from_s;
  return sum;
}

std::vector<Lane> lanes_of(const results::RunRecord& run) {
  std::vector<Lane> lanes(run.uavs.size());
  for (const auto& [key, capture] : whole_captures(run)) lanes[key.first].captures_s.push_back(capture.time_s);
  const auto tracks = run.by_uav(run.poses);
  for (std::size_t uav = 0; uav < lanes.size(); ++uav) {
    std::sort(lanes[uav].captures_s.begin(), lanes[uav].captures_s.end());
    lanes[uav].still = still_spans(tracks[uav], lanes[uav].captures_s);
  }
  add_links(run, lanes);
  add_members(run, lanes);
  for (const results::RunCollision& collision : run.collisions) {
    const auto uav = run.uav_of(collision.uav);
    if (uav && !lanes[*uav].collided_s) lanes[*uav].collided_s = collision.time_s;
  }
  return lanes;
}

LinkShares link_shares(const results::RunRecord& run) {
  LinkShares sums;
  std::map<std::pair<std::string, std::string>, double> up_since;
  for (const results::EventRow& event : run.events) {
    if (!event.is_of_a_link()) continue;
    const std::pair link(event.subject, event.object);
    if (event.event == run_tables::kLinkUp) {
      up_since.try_emplace(link, event.time_s);
    } else if (const auto up = up_since.extract(link)) {
      sums[link] += event.time_s - up.mapped();
    }
  }
  for (const auto& [link, since_s] : up_since) sums[link] += run.end_s - since_s;
  for (auto& [link, sum] : sums) sum = run.end_s > 0.0 ? sum / run.end_s : 0.0;
  return sums;
}

double Latency::quantile(double share) const {
  if (delays_s.empty()) return 0.0;
  const double rank = std::ceil(share * static_cast<double>(delays_s.size()));
  return delays_s[static_cast<std::size_t>(std::clamp(rank, 1.0, static_cast<double>(delays_s.size()))) - 1];
}

Latency latency_of(const results::RunRecord& run) { return merged(latency_by_uav(run)); }

std::vector<Latency> latency_by_uav(const results::RunRecord& run) {
  std::vector<Latency> by_uav(run.uavs.size());
  for (const auto& [key, capture] : whole_captures(run)) {
    Latency& latency = by_uav[key.first];
    if (capture.delivered_at_s) {
      latency.delays_s.push_back(*capture.delivered_at_s - capture.time_s);
    } else {
      ++latency.never;
    }
  }
  for (Latency& latency : by_uav) std::sort(latency.delays_s.begin(), latency.delays_s.end());
  return by_uav;
}

Latency merged(const std::vector<Latency>& parts) {
  Latency all;
  for (const Latency& part : parts) {
    all.delays_s.insert(all.delays_s.end(), part.delays_s.begin(), part.delays_s.end());
    all.never += part.never;
  }
  std::sort(all.delays_s.begin(), all.delays_s.end());
  return all;
}

std::optional<double> processors_of(const Json& result) {
  double cpu_s = 0.0;
  const Json processes = value_or(result, "processes", Json::object());
  for (const Json& use : processes) cpu_s += number_in(use, "cpu_s");
  const double wall_s = number_in(result, "wall_time_s");
  return cpu_s > 0.0 && wall_s > 0.0 ? std::optional(cpu_s / wall_s) : std::nullopt;
}

}  // namespace skein::report
