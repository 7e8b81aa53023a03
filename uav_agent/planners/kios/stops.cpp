#include "uav_agent/planners/kios/stops.hpp"

#include <algorithm>

#include "uav_agent/planning/fleet_tours.hpp"

namespace skein::agent {
namespace {

constexpr double kSpareM = 0.3;  ///< in addition to the clearance; chosen
constexpr double kAsideRatio =
    0.35;                            ///< a stop may lie this many cube edges beside the middle of the free cube; chosen
constexpr int kShifts = 5;           ///< in the middle, and to each of the four sides; geometry
constexpr double kBoxMarginM = 0.5;  ///< surface this far outside a box still belongs to it; chosen
constexpr double kTurnM = 4.0;       ///< extra path per 1 - cosine between two faces' normals: around a corner; chosen
constexpr double kAroundM = 12.0;    ///< extra path if structure is in between; chosen

/// Whether the map knows the place to be free; the inside of structure stays unknown.
bool seen_free(const Vector3d& p_W, const FreeSpace& space) {
  return !space.config().world || space.config().blind_fleet || space.config().world->at(p_W) == Space::free;
}

}  // namespace

KiosStops::Open KiosStops::open_stops(const VoxelGrid& grid, const WorldVoxels& voxels, const FreeSpace& space,
                                      const std::vector<OrientedBox>& boxes, Tick now) const {
  Open open;
  const auto occupied = [&](VoxelGrid::Id id) {
    const int hits = voxels.hits(id);  // none: other UAVs reported the cube as occupied
    return grid.state(id) == VoxelState::occupied && (hits == 0 || hits >= config_.min_hits);
  };
  for (VoxelGrid::Id id = 0; id < grid.count(); ++id) {
    if (!occupied(id)) continue;
    const Vector3d surface = voxels.surface_W(id).value_or(grid.centre_W(id));
    const bool wanted =
        std::ranges::any_of(boxes, [&](const OrientedBox& box) { return box.contains(surface, kBoxMarginM); });
    if (!wanted) continue;
    for (int face = 0; face < VoxelGrid::kFaces; ++face) {
      const auto outside = grid.neighbour(id, face);
      const bool exposed = outside && !occupied(*outside);
      if (!exposed || grid.marked(id, face)) continue;
      const auto failure = failures_.find(VoxelGrid::kFaces * id + static_cast<std::uint32_t>(face));
      if (failure != failures_.end() && now < failure->second.not_before) continue;
      const auto stop = stop_at(VoxelGrid::kFaces * id + static_cast<std::uint32_t>(face), grid, surface, space);
      stop ? open.stops.push_back(*stop) : void(++open.out_of_reach);
    }
  }
  return open;
}

/// The middle of the free cube, unless it is too near to the surface to see much of it or too far to see it sharply. If
/// there is no room, tries the greatest and the least distance, then places beside the middle. Prefers a place that is
/// proved free.
std::optional<KiosStop> KiosStops::stop_at(std::uint32_t id, const VoxelGrid& grid, const Vector3d& surface_W,
                                           const FreeSpace& space) const {
  const int face = static_cast<int>(id % VoxelGrid::kFaces);
  const Vector3d out_W = grid.normal_W(face);
  const Vector3d middle_W = grid.centre_W(id / VoxelGrid::kFaces) + grid.voxel_m() * out_W;
  const double depth = (middle_W - surface_W).dot(out_W);
  const double touch = space.config().clearance_m + kSpareM;
  const double nearest = std::max(touch, config_.nearest_ratio * config_.sharp_m);
  const double farthest = std::max(nearest, config_.standoff_ratio * config_.sharp_m);
  const double aside = kAsideRatio * grid.voxel_m();
  std::optional<KiosStop> unproved;
  for (int shift = 0; shift < kShifts; ++shift) {
    Vector3d shift_W = Vector3d::Zero();
    if (shift > 0) shift_W = aside * grid.normal_W((face / 2 * 2 + 1 + shift) % VoxelGrid::kFaces);
    for (const double distance : {std::clamp(depth, nearest, farthest), farthest, touch}) {
      KiosStop stop{id, middle_W + (distance - depth) * out_W + shift_W, surface_W, out_W};
      stop.p_WB.z() = std::max(stop.p_WB.z(), space.config().floor_m + kSpareM);
      if (!space.free(stop.p_WB)) continue;
      stop.proved = space.cost(stop.p_WB) <= 1.0;
      if (stop.proved) return stop;
      if (!unproved && seen_free(stop.p_WB, space)) unproved = stop;
    }
  }
  return unproved;
}

std::vector<std::size_t> KiosStops::own_tour(const std::vector<KiosStop>& stops, const std::vector<KiosAgent>& agents,
                                             std::size_t self, const VoxelGrid& grid) const {
  std::vector<std::size_t> chosen;
  std::vector<double> reach;
  for (std::size_t i = 0; i < stops.size(); ++i) {
    chosen.push_back(i);
    double nearest = (stops[i].p_WB - agents[self].p_WB).norm();
    for (const KiosAgent& agent : agents) nearest = std::min(nearest, (stops[i].p_WB - agent.p_WB).norm());
    reach.push_back(nearest);
  }
  std::ranges::stable_sort(chosen, [&](std::size_t a, std::size_t b) { return reach[a] < reach[b]; });
  chosen.resize(std::min(chosen.size(), config_.max_tasks));
  FleetTourProblem problem;
  problem.agents = agents.size();
  const std::size_t n = agents.size() + chosen.size();
  problem.costs = CostMatrix(n);
  const auto place = [&](std::size_t node) {
    return node < agents.size() ? agents[node].p_WB : stops[chosen[node - agents.size()]].p_WB;
  };
  for (std::size_t to = agents.size(); to < n; ++to) {
    const Vector3d out_to = stops[chosen[to - agents.size()]].out_W;
    for (std::size_t from = 0; from < n; ++from) {
      double way = (place(to) - place(from)).norm();
      if (!grid.sees(place(from), place(to))) way += kAroundM;
      if (from >= agents.size()) way += kTurnM * (1.0 - out_to.dot(stops[chosen[from - agents.size()]].out_W));
      problem.costs(from, to) = way / config_.speed_mps;
    }
  }
  problem.service.assign(chosen.size(), config_.stop_s);
  for (const KiosAgent& agent : agents) problem.ahead.push_back(agent.busy_s);
  const FleetTours tours = solve_fleet_tours(problem, {.max_evaluations = config_.effort});
  std::vector<std::size_t> own;
  for (const std::size_t node : tours.tours[self]) own.push_back(chosen[node - agents.size()]);
  return own;
}

void KiosStops::failed(std::uint32_t stop, Tick now) {
  Failure& failure = failures_[stop];
  ++failure.count;
  failure.not_before = now + failure.count * ticks(config_.retry_s);
}

}  // namespace skein::agent
