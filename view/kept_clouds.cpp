#include "view/kept_clouds.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/topics.hpp"
#include "core/types.hpp"
#include "idl/cdr.hpp"
#include "idl/conversions.hpp"
#include "recording/mcap/reader.hpp"
#include "results/octree_file.hpp"
#include "results/run_folder.hpp"
#include "view/cube_runs.hpp"
#include "view/look_order.hpp"
#include "view/map_files.hpp"

namespace skein::view {
namespace {

constexpr double kPointsStep_s = 0.5;
constexpr const char* kKeyFrameMap = "its map of key frames at the end";
constexpr const char* kFlightMap = "what it flies on";

double height_at(const std::map<double, double>& heights, double time_s) {
  const auto after = heights.upper_bound(time_s);
  return after == heights.begin() ? 0.0 : std::prev(after)->second;
}

/// The recorded topic of a UAV's scans: its wire name without "rt".
std::string scans_of(const std::string& uav) { return topics::cloud(uav).name.substr(2); }

bool has_any(const mcap::Reader& reader, const std::map<std::string, std::size_t>& wanted) {
  bool any = !reader.complete();  // a recording that is cut off has no summary
  reader.summary([&](const mcap::RawRecord& record) {
    if (record.opcode != mcap::Opcode::channel) return;
    const auto channel = mcap::parse<mcap::Channel>(record.content);
    any = any || (channel && wanted.contains(channel->topic));
  });
  return any;
}

/// Collects the points of one UAV, scan by scan, in steps of kPointsStep_s.
class Gathered {
 public:
  void add(double time_s, const std::vector<ScanPoint>& scan) {
    if (time_s - begin_s_ >= kPointsStep_s) {
      end_step();
      begin_s_ = time_s;
    }
    newest_s_ = time_s;
    std::vector<Eigen::Vector3f> points_W;
    points_W.reserve(scan.size());
    for (const ScanPoint& p : scan) points_W.emplace_back(p.x, p.y, p.z);
    seen_.add(points_W);
  }
  std::vector<PointsStep> take() {
    end_step();
    return std::move(steps_);
  }

 private:
  void end_step() {
    if (!seen_.empty()) steps_.push_back({newest_s_, seen_.take_new()});
  }

  ScanPoints seen_{KeptClouds::kMostPointsKept};
  double begin_s_ = 0.0, newest_s_ = 0.0;
  std::vector<PointsStep> steps_;
};

}  // namespace

KeptClouds::KeptClouds(const std::filesystem::path& dir, const results::RunRecord& run, const Heights& heights)
    : run_(run), points_(run.uavs.size()), in_time_(run.uavs.size()) {
  try {
    read_recording(dir / run_folder::kRecording);
  } catch (const InputError&) {
    points_.assign(run.uavs.size(), {});  // no recording, or a damaged one
  }
  for (std::size_t i = 0; i < run.uavs.size(); ++i) {
    if (!points_[i].empty()) lidar.push_back(run.uavs[i]);
    in_time_[i] = read_maps(dir, run.uavs[i],
                            [&](double time_s) { return i < heights.size() ? height_at(heights[i], time_s) : 0.0; });
    if (in_time_[i] || (i < run.maps.size() && !run.maps[i].empty())) maps.push_back(run.uavs[i]);
  }
  say_what_is_missing(dir);
}

void KeptClouds::say_what_is_missing(const std::filesystem::path& dir) {
  const bool explorers = std::ranges::count(run_.explorer, true) > 0;
  if (lidar.empty() && explorers) missing = "The recording has no LiDAR points: a run with --record=clouds has.";
  if (maps.empty() || std::ranges::any_of(in_time_, [](const auto& map) { return map.has_value(); })) return;
  if (!missing.empty()) missing += ' ';
  missing += "Maps are those of the end. Maps in time: ";
  missing += std::filesystem::exists(dir / run_folder::kRecording)
                 ? "`skein replay RUN --maps` computes them, with the folder of this run as RUN."
                 : "a run with --keep-maps has them; of this one they cannot be computed, since it has no recording.";
}

void KeptClouds::read_recording(const std::filesystem::path& file) {
  std::map<std::string, std::size_t> wanted;
  for (std::size_t i = 0; i < run_.uavs.size(); ++i) wanted[scans_of(run_.uavs[i])] = i;
  mcap::Reader reader(file);
  if (!has_any(reader, wanted)) return;
  std::vector<Gathered> gathered(run_.uavs.size());
  reader.messages([&](const mcap::Channel& channel, const mcap::Message& message) {
    const auto uav = wanted.find(channel.topic);
    msg::PointCloud2 cloud;
    if (uav == wanted.end() || !decode(message.data, cloud)) return;
    gathered[uav->second].add(seconds(from_time(cloud.header().stamp())), from_cloud<ScanPoint>(cloud));
  });
  for (std::size_t i = 0; i < gathered.size(); ++i) points_[i] = gathered[i].take();
}

void KeptClouds::tell(std::span<const ShownUav> last, Feed& feed) const {
  for (std::size_t i = 0; i < run_.uavs.size(); ++i) {
    const std::string& uav = run_.uavs[i];
    if (!points_[i].empty()) feed.set_cloud(lidar_cloud(uav), lidar_text(uav, points_[i]));
    if (in_time_[i]) feed.set_cloud(map_cloud(uav), map_text(uav, *in_time_[i], kFlightMap));
    if (in_time_[i] || i >= run_.maps.size()) continue;
    const auto file = results::octree_of_file(run_.maps[i]);
    const double slice_m = i < last.size() ? last[i].body.p_WB.z() : 0.0;
    const auto map = file ? shown_map(file->tree, file->cell_m, slice_m) : std::nullopt;
    if (map) feed.set_cloud(map_cloud(uav), map_text(uav, run_.end_s, *map, kKeyFrameMap));
  }
}

}  // namespace skein::view
