#include "uav_agent/flight/voxel_route.hpp"

namespace skein::agent {
namespace {

using Id = VoxelGrid::Id;

class Router {
 public:
  Router(const VoxelGrid& grid, const FreeSpace& space, const Vector3d& from_W, const Vector3d& to_W,
         const std::set<Id>& claimed)
      : grid_(grid),
        space_(space),
        from_W_(from_W),
        to_W_(to_W),
        claimed_(claimed),
        from_(grid.at(from_W)),
        to_(grid.at(to_W)) {}

  std::optional<std::vector<Vector3d>> run(const VoxelRouteConfig& config) {
    if (leg_free(from_W_, to_W_)) return std::vector<Vector3d>{to_W_};
    if (!from_ || !to_) return std::nullopt;
    for (int attempt = 0; attempt <= config.retries; ++attempt) {
      const auto ids = find_voxel_path(
          grid_, *from_, *to_, [this](Id id) { return passable(id); }, config.search);
      if (!ids) return std::nullopt;
      if (auto corners = corners_of(*ids)) return corners;
    }
    return std::nullopt;
  }

 private:
  bool open(Id id) const {
    if (id == from_) return true;
    return !claimed_.contains(id) && (id == to_ || grid_.state(id) != VoxelState::occupied);
  }
  bool passable(Id id) const {
    return open(id) && (id == to_ || (!banned_.contains(id) && space_.free(grid_.centre_W(id))));
  }
  bool leg_free(const Vector3d& a_W, const Vector3d& b_W) const {
    bool through = true;
    grid_.along(a_W, b_W, [&](Id id) { return through = open(id); });
    return through && space_.segment_free(a_W, b_W);
  }

  /// Corners of the path along the centres of cubes, with short cuts. If a leg is not free after all, bans the cube at
  /// its end, and returns nullopt.
  std::optional<std::vector<Vector3d>> corners_of(const std::vector<Id>& ids) {
    std::vector<Vector3d> places, corners;
    for (const Id id : ids) places.push_back(grid_.centre_W(id));
    if (places.empty()) return std::nullopt;
    places.back() = to_W_;
    Vector3d at = from_W_;
    for (std::size_t next = 0; next < places.size();) {
      std::size_t far = places.size() - 1;
      while (far > next && !leg_free(at, places[far])) far = next + (far - next) / 2;
      const bool out_of_trouble = next == 0 && !space_.free(from_W_);  // from there, no leg is free
      if (!out_of_trouble && far == next && !leg_free(at, places[far])) {
        banned_.insert(ids[far]);
        return std::nullopt;
      }
      at = places[far];
      corners.push_back(at);
      next = far + 1;
    }
    return corners;
  }

  const VoxelGrid& grid_;
  const FreeSpace& space_;
  const Vector3d from_W_, to_W_;
  const std::set<Id>& claimed_;
  const std::optional<Id> from_, to_;
  std::set<Id> banned_;
};

}  // namespace

std::optional<std::vector<Vector3d>> find_voxel_route(const VoxelGrid& grid, const FreeSpace& space,
                                                      const Vector3d& from_W, const Vector3d& to_W,
                                                      const std::set<Id>& claimed, const VoxelRouteConfig& config) {
  return Router(grid, space, from_W, to_W, claimed).run(config);
}

std::optional<std::vector<bool>> voxels_in_reach(const VoxelGrid& grid, const FreeSpace& space,
                                                 const Vector3d& from_W) {
  const auto from = grid.at(from_W);
  if (!from) return std::nullopt;
  return voxels_in_reach(
      grid, *from, [&](Id id) { return grid.state(id) != VoxelState::occupied && space.free(grid.centre_W(id)); });
}

}  // namespace skein::agent
