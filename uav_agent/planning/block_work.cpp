#include "uav_agent/planning/block_work.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/math/euler.hpp"

namespace skein::agent {
namespace {

constexpr std::size_t kFewCells = 4;  ///< a block with fewer occupied cells counts as empty; chosen
constexpr double kThinnestM = 2.0;    ///< least thickness of a tight box around a thin member; chosen
constexpr double kCellM = 0.5;        ///< added to the extent of the cells' centres; geometry: an edge of a cell
constexpr double kGapM = 2.0;         ///< a face is inside the structure if the next block's is nearer; chosen
constexpr double kSharedFace = 0.5;   ///< and covers more than this share of the face; chosen
constexpr int kTurns = 12;            ///< number of yaw angles tried for a tight box, within a right angle; chosen
/// A turned box must have less than this share of the aligned box's area. Chosen.
constexpr double kTurnGain = 0.8;
/// Costs: of another UAV's block, of one that was flown, of one that failed. Chosen.
constexpr double kOthersS = 25.0, kFlownS = 90.0, kFailedS = 30.0;
constexpr double kRetryS = 30.0;  ///< wait after a failure; twice as long after the second one, and so on; chosen
constexpr double kNoGain = 1e-9;  ///< a smaller gain is a rounding error

/// The block that contains a point. Blocks along an axis are counted from the box's lower end.
Eigen::Vector3i block_of(const Vector3d& p_O, const Vector3d& size, const Eigen::Vector3i& count) {
  const Vector3d share = (p_O + 0.5 * size).cwiseQuotient(size).cwiseProduct(count.cast<double>());
  return share.array().floor().matrix().cast<int>().cwiseMax(0).cwiseMin(count - Eigen::Vector3i::Ones());
}

std::size_t index_of(const Eigen::Vector3i& block, const Eigen::Vector3i& count) {
  return static_cast<std::size_t>(block.x() + count.x() * (block.y() + count.y() * block.z()));
}

/// Widens the box of a thin member, so that it gets strips on all sides. The box of a wall stays as it is: its narrow
/// side is not worth a flight.
Eigen::AlignedBox3d not_too_thin(const Eigen::AlignedBox3d& extent) {
  Vector3d half = 0.5 * (extent.sizes() + Vector3d::Constant(kCellM));
  Vector3d sorted = half;
  std::sort(sorted.data(), sorted.data() + 3);
  if (sorted[1] < 0.5 * kThinnestM) half = half.cwiseMax(0.5 * kThinnestM);
  return {extent.center() - half, extent.center() + half};
}

Eigen::AlignedBox3d extent_of(const std::vector<Vector3d>& cells_O, double turn) {
  const Matrix3d R = rotation_z(-turn);
  Eigen::AlignedBox3d extent;
  for (const Vector3d& p_O : cells_O) extent.extend(R * p_O);
  return not_too_thin(extent);
}

/// The box around the cells of a block with the smallest base, turned about the vertical: members may run in any
/// direction.
OrientedBox tight_box(const OrientedBox& site, const std::vector<Vector3d>& cells_O) {
  double best_turn = 0.0, best_area = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kTurns; ++i) {
    const double turn = 0.5 * std::numbers::pi * i / kTurns;
    const Vector3d size = extent_of(cells_O, turn).sizes();
    const double area = size.x() * size.y();
    if (area >= best_area - kNoGain) continue;
    best_area = i == 0 ? kTurnGain * area : area;
    best_turn = turn;
  }
  const Eigen::AlignedBox3d extent = extent_of(cells_O, best_turn);
  OrientedBox box;
  box.R_WO = site.R_WO * rotation_z(best_turn);
  box.center = site.center + box.R_WO * extent.center();
  box.size = extent.sizes();
  return box;
}

/// Whether the structure of the neighbouring block covers most of a face.
bool covered(const Eigen::AlignedBox3d& own, const Eigen::AlignedBox3d& other, int axis, bool upper) {
  if (other.isEmpty()) return false;
  const double gap = upper ? other.min()[axis] - own.max()[axis] : own.min()[axis] - other.max()[axis];
  if (gap > kGapM) return false;
  double shared = 1.0;
  for (const int side : {(axis + 1) % 3, (axis + 2) % 3}) {
    const double overlap = std::min(own.max()[side], other.max()[side]) - std::max(own.min()[side], other.min()[side]);
    shared *= std::max(0.0, overlap) / own.sizes()[side];
  }
  return shared > kSharedFace;
}

}  // namespace

std::size_t block_owner(const Eigen::Vector3i& block, std::size_t uavs) {
  return static_cast<std::size_t>(block.x() + 2 * block.y() + 3 * block.z()) % uavs;
}

BlockWork::BlockWork(const Config& config, const AgentConfig& agent, const CameraReach& reach,
                     const std::vector<OrientedBox>& boxes)
    : config_(config), agent_(agent), reach_(reach) {
  for (const OrientedBox& box : boxes) {
    if (!is_site_box(box)) continue;
    const Vector3d count = (box.size / config.block_m).array().round().max(1.0);
    sites_.push_back({box, count.cast<int>()});
  }
}

std::optional<BlockWork::Task> BlockWork::next(Tick now, const Vector3d& p_WB, const OccupancyMap& map) {
  const bool stale = !looked_at_ || seconds(now - *looked_at_) >= config_.look_again_s;
  if (stale && map.revision() != revision_) {
    looked_at_ = now;
    revision_ = map.revision();
    look(map);
  }
  std::optional<Task> best;
  double best_cost = 0.0;
  for (const Job& job : jobs_) {
    const auto record = records_.find(job.key);
    const Record known = record == records_.end() ? Record() : record->second;
    if (now < known.not_before) continue;
    for (const bool reversed : {false, true}) {
      const double way = ((reversed ? job.strip.end_W : job.strip.begin_W) - p_WB).norm();
      const double cost =
          way / config_.transit_mps + (job.own ? 0.0 : kOthersS) + kFlownS * known.flown + kFailedS * known.failed;
      if (best && cost >= best_cost - kNoGain) continue;
      best = Task{job.key, job.strip, reversed, known.flown};
      best_cost = cost;
    }
  }
  return best;
}

void BlockWork::failed(const Task& task, Tick now) {
  Record& record = records_[task.key];
  ++record.failed;
  record.not_before = now + ticks(kRetryS * record.failed);
}

void BlockWork::look(const OccupancyMap& map) {
  jobs_.clear();
  for (std::size_t s = 0; s < sites_.size(); ++s) {
    const Site& site = sites_[s];
    std::vector<std::vector<Vector3d>> cells_O(static_cast<std::size_t>(site.count.prod()));
    map.visit_occupied(site.box, [&](const Vector3d& p_W) {
      const Vector3d p_O = site.box.R_WO.transpose() * (p_W - site.box.center);
      cells_O[index_of(block_of(p_O, site.box.size, site.count), site.count)].push_back(p_O);
    });
    std::vector<Eigen::AlignedBox3d> extents_O;
    for (const auto& cells : cells_O) {
      extents_O.push_back(cells.size() < kFewCells ? Eigen::AlignedBox3d() : extent_of(cells, 0.0));
    }
    for (std::size_t index = 0; index < cells_O.size(); ++index) {
      if (!extents_O[index].isEmpty()) cut(s, index, tight_box(site.box, cells_O[index]), extents_O);
    }
  }
}

void BlockWork::cut(std::size_t s, std::size_t index, const OrientedBox& box,
                    const std::vector<Eigen::AlignedBox3d>& extents_O) {
  const Site& site = sites_[s];
  const Eigen::Vector3i count = site.count;
  const auto i = static_cast<int>(index);
  const Eigen::Vector3i block(i % count.x(), i / count.x() % count.y(), i / (count.x() * count.y()));
  const std::size_t owner = block_owner(block, agent_.fleet.size());
  int number[6] = {};
  for (const Strip& strip : cut_into_strips({box}, reach_, config_.strips)) {
    const Vector3d out_O = site.box.R_WO.transpose() * strip.out_W;
    Eigen::Index axis = 0;
    out_O.cwiseAbs().maxCoeff(&axis);
    const bool upper = out_O[axis] > 0.0;
    const int face = 2 * static_cast<int>(axis) + (upper ? 1 : 0);
    const Key key(s, index, face, number[face]++);
    Eigen::Vector3i next = block;
    next[axis] += upper ? 1 : -1;
    const bool inside = (next.array() >= 0).all() && (next.array() < count.array()).all();
    if (inside && covered(extents_O[index], extents_O[index_of(next, count)], static_cast<int>(axis), upper)) continue;
    jobs_.push_back({key, strip, owner == agent_.self});
  }
}

}  // namespace skein::agent
