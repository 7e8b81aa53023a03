#include "uav_agent/onboard/key_frame_filter.hpp"

// Compiles PCL's filters in this file. With libpcl_filters and its dependencies, a program would have to resolve 60,000
// symbols at its start, which takes most of its start-up time.
#define PCL_NO_PRECOMPILE
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace skein::agent {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

constexpr float kHorizonM = 1e4F;  ///< greatest |x| and |y| of a plausible point; chosen
/// Entries tried on each side, beside `wanted`. Measured: 1 point in 14 is then searched.
constexpr std::uint32_t kListed = 7;

/// Finds the neighbours of points, which are sorted by their cells in a grid.
/// PCL's RadiusOutlierRemoval asks a kd-tree for each point, which costs a futex call each time (FLANN's OpenMP).
class Neighbourhood {
 public:
  Neighbourhood(const std::vector<Eigen::Vector3f>& points, float radius) : points_(points), radius_(radius) {}

  /// Whether at least `wanted` other points are at most a radius away from point i.
  bool has_neighbours(std::uint32_t i, int wanted) {
    return wanted <= 0 || has_listed_neighbours(i, wanted) || has_searched_neighbours(i, wanted);
  }

 private:
  struct Entry {
    std::uint64_t cell;
    std::uint32_t point;
    auto operator<=>(const Entry&) const = default;
  };

  /// Thinned points are listed voxel by voxel, so points near each other are mostly near each other in the list.
  bool has_listed_neighbours(std::uint32_t i, int wanted) const {
    const std::uint32_t reach = kListed + static_cast<std::uint32_t>(wanted);
    const std::size_t end = std::min<std::size_t>(points_.size(), std::size_t{i} + reach + 1);
    for (std::size_t j = i - std::min(i, reach); j < end; ++j) {
      if (j != i && near(points_[j], points_[i]) && --wanted == 0) return true;
    }
    return false;
  }

  bool has_searched_neighbours(std::uint32_t i, int wanted) {
    if (entries_.empty()) sort();
    const Eigen::Vector3i c = cell(points_[i]);
    // Begins with the point's own row: there is nearly always a neighbour in it.
    for (const int dz : {0, -1, 1}) {
      for (const int dy : {0, -1, 1}) {
        const Eigen::Vector3i row = c + Eigen::Vector3i(0, dy, dz);
        const std::uint64_t last = key(row + Eigen::Vector3i(1, 0, 0));
        for (auto it = std::ranges::lower_bound(entries_, Entry{key(row - Eigen::Vector3i(1, 0, 0)), 0});
             it != entries_.end() && it->cell <= last; ++it) {
          if (it->point != i && near(points_[it->point], points_[i]) && --wanted == 0) return true;
        }
      }
    }
    return false;
  }

  void sort() {
    entries_.reserve(points_.size());
    for (std::uint32_t i = 0; i < points_.size(); ++i) entries_.push_back({key(cell(points_[i])), i});
    std::ranges::sort(entries_);
  }

  Eigen::Vector3i cell(const Eigen::Vector3f& p) const { return (p / radius_).array().floor().matrix().cast<int>(); }
  /// Cells adjacent along x have consecutive keys. Within kHorizonM, cells of 2 cm and more fit 21 bits per axis.
  static std::uint64_t key(const Eigen::Vector3i& c) {
    constexpr std::int64_t kOffset = 1 << 20;  // format: no number is negative
    const auto bits = [](int i) { return static_cast<std::uint64_t>(i + kOffset); };
    return bits(c.z()) << 42 | bits(c.y()) << 21 | bits(c.x());
  }
  bool near(const Eigen::Vector3f& a, const Eigen::Vector3f& b) const {
    return (a - b).squaredNorm() <= radius_ * radius_;
  }

  const std::vector<Eigen::Vector3f>& points_;
  const float radius_;
  std::vector<Entry> entries_;  ///< filled at the first search
};

}  // namespace

KnownBodies::KnownBodies(const std::vector<KnownBody>& bodies) {
  for (const KnownBody& body : bodies) {
    if (!std::isfinite(body.p_W.x())) continue;
    bodies_.push_back(body);
    reach_ = std::max(reach_, body.radius_m);
  }
  std::ranges::sort(bodies_, {}, x_of);
  reach_ += 1e-6 + 1e-9 * reach_;  // so that rounding excludes no body; the exact distance decides
}

bool KnownBodies::hold(const Vector3d& p_W) const {
  for (auto body = std::ranges::lower_bound(bodies_, p_W.x() - reach_, {}, x_of);
       body != bodies_.end() && x_of(*body) <= p_W.x() + reach_; ++body) {
    if ((p_W - body->p_W).squaredNorm() <= body->radius_m * body->radius_m) return true;
  }
  return false;
}

std::vector<Eigen::Vector3f> KeyFrameFilter::sound(const std::vector<Eigen::Vector3f>& points_W,
                                                   const KnownBodies& bodies) const {
  std::vector<Eigen::Vector3f> sound;
  sound.reserve(points_W.size());
  for (const Eigen::Vector3f& p_W : points_W) {
    const Vector3d p = p_W.cast<double>();
    if (p.allFinite() && p_W.head<2>().cwiseAbs().maxCoeff() <= kHorizonM && p.z() >= config_.lowest_m &&
        p.z() <= config_.highest_m && !bodies.hold(p)) {
      sound.push_back(p_W);
    }
  }
  return sound;
}

std::vector<Eigen::Vector3f> KeyFrameFilter::thinned(const std::vector<Eigen::Vector3f>& sound_W) const {
  if (sound_W.empty()) return {};
  auto cloud = std::make_shared<Cloud>();
  cloud->reserve(sound_W.size());
  for (const Eigen::Vector3f& p_W : sound_W) cloud->push_back({p_W.x(), p_W.y(), p_W.z()});

  Cloud thinned;
  pcl::VoxelGrid<pcl::PointXYZ> voxels;
  voxels.setInputCloud(cloud);
  voxels.setLeafSize(Eigen::Vector4f::Constant(static_cast<float>(config_.voxel_m)));
  voxels.filter(thinned);

  std::vector<Eigen::Vector3f> points;
  points.reserve(thinned.size());
  for (const auto& p : thinned) points.emplace_back(p.x, p.y, p.z);
  if (config_.lone_min_neighbours <= 0 || points.size() < 2) return points;

  Neighbourhood neighbourhood(points, static_cast<float>(config_.lone_radius_m));
  std::vector<Eigen::Vector3f> kept;
  kept.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (neighbourhood.has_neighbours(i, config_.lone_min_neighbours)) kept.push_back(points[i]);
  }
  return kept;
}

}  // namespace skein::agent
