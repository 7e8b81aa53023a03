#include "uav_agent/planners/star/explorer.hpp"

#include <algorithm>
#include <cmath>

#include "uav_agent/planners/star/tour.hpp"
#include "uav_agent/planning/viewpoints.hpp"

namespace skein::agent {
namespace {

using Id = VoxelGrid::Id;

constexpr std::size_t kMaxClusters = 24;  ///< most clusters in one plan: the nearest; chosen
constexpr std::size_t kMaxTargets = 14;   ///< most cubes of a cluster whose visibility is checked; chosen
/// Viewpoints of a cluster at one height. Chosen; FUEL has 3 rings, and a viewpoint every 15 degrees.
constexpr int kRings = 2, kDirections = 10;
constexpr double kHeightM = 3.0;    ///< viewpoints lie at the cluster's height, and this much above and below; chosen
constexpr double kGoodShare = 0.8;  ///< share of the best coverage that suffices for the refinement; chosen
constexpr std::size_t kMaxOptions = 5;  ///< most viewpoints of a cluster in the refinement; chosen; FUEL: 15
constexpr double kViewRangeM = 20.0;    ///< a viewpoint sees cubes within this distance; chosen
constexpr double kLowM = 2.0;           ///< unknown cubes below this height count as ground; chosen
constexpr double kLookMarginM = 1.0;    ///< a look counts up to this distance beyond the outer ring; chosen

}  // namespace

/// Viewpoints of one cluster, best first.
struct StarExplorer::Options {
  std::size_t cluster = 0;
  std::vector<Vector3d> places_W;
};

bool StarExplorer::worth_a_look(const VoxelGrid& grid, Id id) const {
  for (int face = 0; face < VoxelGrid::kFaces; ++face) {
    const auto next = grid.neighbour(id, face);
    if (!next || grid.state(*next) != VoxelState::unknown || grid.centre_W(*next).z() < kLowM) continue;
    bool behind_surface = false;
    for (int side = 0; side < VoxelGrid::kFaces; ++side) {
      const auto beside = grid.neighbour(*next, side);
      behind_surface |= beside && grid.state(*beside) == VoxelState::occupied;
    }
    if (!behind_surface) return true;
  }
  return false;
}

void StarExplorer::look(const VoxelGrid& grid, const std::vector<Id>& changed, const Vector3d& p_W) {
  frontiers_.update(grid, changed);
  const double range = config_.ring_outer_m + kLookMarginM;
  for (const Id id : frontiers_.cubes()) {
    const Vector3d centre = grid.centre_W(id);
    const bool counts = looks_[id] < config_.looks && (centre - p_W).squaredNorm() < range * range;
    if (counts && grid.sees(p_W, centre)) ++looks_[id];
  }
}

std::vector<CubeCluster> StarExplorer::clusters(const VoxelGrid& grid, const OrientedBox& box, const Vector3d& p_W,
                                                Tick now) const {
  std::vector<Id> open;
  for (const Id id : frontiers_.cubes()) {
    if (looks_[id] >= config_.looks || now < not_before_[id]) continue;
    if (box.contains(grid.centre_W(id), config_.margin_m) && worth_a_look(grid, id)) open.push_back(id);
  }
  auto all = clusters_of(grid, open, config_.cluster_m, config_.min_cluster);
  std::ranges::stable_sort(all, {}, [&](const CubeCluster& cluster) { return (cluster.middle_W - p_W).norm(); });
  if (all.size() > kMaxClusters) all.resize(kMaxClusters);
  return all;
}

StarExplorer::Options StarExplorer::options_for(const VoxelGrid& grid, const FreeSpace& space,
                                                const CubeCluster& cluster) const {
  std::vector<Vector3d> targets;
  const std::size_t stride = cluster.cubes.size() / kMaxTargets + 1;
  for (std::size_t i = 0; i < cluster.cubes.size(); i += stride) targets.push_back(grid.centre_W(cluster.cubes[i]));
  const RingConfig ring{config_.ring_inner_m, config_.ring_outer_m, kRings, kDirections, {0.0, kHeightM, -kHeightM}};
  std::vector<std::pair<std::size_t, Vector3d>> found;
  for (const Vector3d& p : ring_around(cluster.middle_W, ring)) {
    if (!space.free(p) || space.cost(p) > 1.0) continue;  // only in space that is proved free, as in FUEL
    const std::size_t seen = visible_targets(grid, p, 0.0, 0.0, targets, {.range_m = kViewRangeM}).size();
    if (seen > 0) found.emplace_back(seen, p);
  }
  std::ranges::stable_sort(found, std::greater<>(), &std::pair<std::size_t, Vector3d>::first);
  Options options;
  for (const auto& [seen, p] : found) {
    const bool good = static_cast<double>(seen) >= kGoodShare * static_cast<double>(found.front().first);
    if (good && options.places_W.size() < kMaxOptions) options.places_W.push_back(p);
  }
  return options;
}

std::vector<std::size_t> StarExplorer::order(const std::vector<Options>& options, const StarStart& start) const {
  std::vector<Vector3d> places;
  std::vector<double> extra_s;
  for (const Options& option : options) {
    places.push_back(option.places_W.front());
    const bool taken = std::ranges::any_of(
        start.mates_W, [&](const Vector3d& mate) { return (mate - places.back()).norm() < config_.ring_outer_m; });
    extra_s.push_back(taken ? config_.mate_s : 0.0);
  }
  return order_of_visit(start.p_WB, start.v_WB, places, extra_s,
                        {.speed_mps = config_.speed_mps, .turn_s = config_.turn_s, .effort = config_.effort});
}

std::vector<StarGoal> StarExplorer::tour(const VoxelGrid& grid, const FreeSpace& space, const OrientedBox& box,
                                         const StarStart& start, Tick now) const {
  const std::vector<CubeCluster> found = clusters(grid, box, start.p_WB, now);
  std::vector<Options> options;
  for (std::size_t i = 0; i < found.size(); ++i) {
    Options of_one = options_for(grid, space, found[i]);
    of_one.cluster = i;
    if (!of_one.places_W.empty()) options.push_back(std::move(of_one));
  }
  const std::vector<std::size_t> visits = order(options, start);
  std::vector<std::vector<Vector3d>> next;
  for (std::size_t i = 0; i < visits.size() && static_cast<int>(i) < config_.refine; ++i) {
    next.push_back(options[visits[i]].places_W);
  }
  const std::vector<std::size_t> choice = shortest_through(start.p_WB, next);
  std::vector<StarGoal> goals;
  for (std::size_t i = 0; i < visits.size(); ++i) {
    const Options& option = options[visits[i]];
    const CubeCluster& cluster = found[option.cluster];
    goals.push_back({option.places_W[i < choice.size() ? choice[i] : 0], cluster.middle_W, cluster.cubes});
  }
  return goals;
}

bool StarExplorer::open(const StarGoal& goal) const {
  const auto left = std::ranges::count_if(
      goal.cubes, [&](Id id) { return frontiers_.cubes().contains(id) && looks_[id] < config_.looks; });
  return 2 * static_cast<std::size_t>(left) > goal.cubes.size();
}

void StarExplorer::failed(const StarGoal& goal, Tick now) {
  for (const Id id : goal.cubes) not_before_[id] = now + ticks(config_.retry_s);
}

}  // namespace skein::agent
