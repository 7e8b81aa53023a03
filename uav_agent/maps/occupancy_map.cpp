#include "uav_agent/maps/occupancy_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/files/octree_bytes.hpp"
#include "uav_agent/maps/known_space.hpp"

namespace skein::agent {
namespace {

constexpr int kFineSteps = 8;            ///< fine samples of cast() for each coarse one; even; chosen
constexpr double kMostHeardCells = 1e6;  ///< memory: eight million cubic metres of free space
constexpr double kNoLengthM = 1e-9;      ///< numeric: a shorter segment is a point

}  // namespace

struct OccupancyMap::Impl {
  explicit Impl(const Config& c) : config(c), known(c.resolution_m, c.free_resolution_m) {}

  const Config config;
  KnownSpace known;
  std::uint64_t revision = 0, key_frames = 0;
};

OccupancyMap::OccupancyMap() : OccupancyMap(Config()) {}
OccupancyMap::OccupancyMap(const Config& config) : impl_(std::make_unique<Impl>(config)) {}
OccupancyMap::~OccupancyMap() = default;
OccupancyMap::OccupancyMap(OccupancyMap&&) noexcept = default;
OccupancyMap& OccupancyMap::operator=(OccupancyMap&&) noexcept = default;

FrameCells OccupancyMap::trace(const std::vector<Eigen::Vector3f>& hits_W, const std::optional<Vector3d>& p_WS) const {
  const Config& config = impl_->config;
  FrameCells frame{impl_->known.cells_of_hits(hits_W, config.ground_m), {}};
  if (!p_WS) return frame;
  std::vector<Vector3d> ends_W;
  const std::size_t stride = std::max<std::size_t>(1, hits_W.size() / std::max(1, config.max_free_rays));
  for (std::size_t i = 0; i < hits_W.size(); i += stride) {
    const Vector3d to_hit = hits_W[i].cast<double>() - *p_WS;
    // The hit's own cell is not free: the ray ends one cell's edge before the hit, where it at most grazes that cell.
    const double length = std::min(to_hit.norm() - config.free_resolution_m, config.free_range_m);
    if (length <= 0.0) continue;
    ends_W.push_back(*p_WS + to_hit.normalized() * length);
  }
  frame.passed = impl_->known.passed_by_rays(*p_WS, ends_W);
  return frame;
}

void OccupancyMap::insert(const std::vector<Eigen::Vector3f>& hits_W, const std::optional<Vector3d>& p_WS) {
  insert(trace(hits_W, p_WS));
}

void OccupancyMap::insert(const FrameCells& frame) {
  if (impl_->known.add_hits(frame.hits)) ++impl_->revision;
  impl_->known.add_rays(frame.passed);
  ++impl_->key_frames;
}

bool OccupancyMap::empty() const { return impl_->known.hits().count() == 0; }
std::size_t OccupancyMap::occupied_cells() const { return impl_->known.hits().count(); }
std::uint64_t OccupancyMap::revision() const { return impl_->revision; }
std::uint64_t OccupancyMap::key_frames() const { return impl_->key_frames; }
const OccupancyMap::Config& OccupancyMap::config() const { return impl_->config; }

bool OccupancyMap::occupied(const Vector3d& p_W) const { return impl_->known.hits().test(p_W); }

bool OccupancyMap::known_free(const Vector3d& p_W, int rays) const {
  const int passed = impl_->known.rays_at(p_W);
  return passed > 0 && passed >= std::min(rays, kCountedRays) && !occupied(p_W);
}

bool OccupancyMap::any_occupied_within(const Vector3d& p_W, double radius) const {
  return impl_->known.hits().nearest_squared(p_W, radius, true).has_value();
}

std::optional<double> OccupancyMap::distance_to_occupied(const Vector3d& p_W, double max_distance) const {
  const auto squared = impl_->known.hits().nearest_squared(p_W, max_distance, false);
  return squared ? std::optional(std::sqrt(*squared)) : std::nullopt;
}

bool OccupancyMap::segment_clear(const Vector3d& a_W, const Vector3d& b_W, double radius) const {
  const double length = (b_W - a_W).norm();
  if (length < kNoLengthM) return !any_occupied_within(a_W, radius);
  return !cast(a_W, (b_W - a_W) / length, length, radius).has_value();
}

std::optional<double> OccupancyMap::cast(const Vector3d& from_W, const Vector3d& direction, double max_distance,
                                         double radius) const {
  // Balls around samples that are h apart cover a tube of `radius` if ball^2 = radius^2 + (h/2)^2. Coarse balls quickly
  // exclude stretches without obstacles; fine ones find the distance, a few per cent on the safe side.
  const double h = std::max(2.0 * radius, impl_->config.resolution_m);
  const double fine_h = h / kFineSteps;
  const double ball = std::hypot(radius, 0.5 * h), fine_ball = std::hypot(radius, 0.5 * fine_h);
  const int samples = static_cast<int>(std::ceil(max_distance / h));
  for (int i = 0; i <= samples; ++i) {
    const double s = std::min(i * h, max_distance);
    if (!any_occupied_within(from_W + s * direction, ball)) continue;
    for (int j = -kFineSteps / 2; j <= kFineSteps / 2; ++j) {
      const double t = std::clamp(s + j * fine_h, 0.0, max_distance);
      if (any_occupied_within(from_W + t * direction, fine_ball)) return t;
    }
  }
  return std::nullopt;
}

void OccupancyMap::visit_occupied(const OrientedBox& box, const std::function<void(const Vector3d&)>& visit) const {
  const Vector3d half = box.R_WO.cwiseAbs() * (0.5 * box.size);
  impl_->known.visit_hits(box.center - half, box.center + half, [&](const Vector3d& p_W) {
    if (box.contains(p_W)) visit(p_W);
  });
}

std::string OccupancyMap::octomap_bytes(int rays) const { return impl_->known.octomap_bytes(rays); }
bool OccupancyMap::hear(std::string_view bytes, int rays) {
  std::vector<KnownCube> cubes;
  double cells = 0.0;
  const double cell_m = impl_->config.resolution_m;
  const auto whole = visit_octree(bytes, cell_m, [&](const KnownCube& cube) {
    cells += std::pow(cube.edge_m / (cube.occupied ? cell_m : impl_->config.free_resolution_m), 3);
    if (cells <= kMostHeardCells) cubes.push_back(cube);
  });
  if (!whole || cells > kMostHeardCells) return false;
  if (impl_->known.hear(cubes, rays)) ++impl_->revision;
  return true;
}

std::string OccupancyMap::octomap_file(int rays) const { return impl_->known.octomap_file(rays); }

}  // namespace skein::agent
