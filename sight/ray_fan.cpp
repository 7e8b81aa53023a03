#include "sight/ray_fan.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "sight/ray_fan_tree.hpp"

namespace skein::sim {
namespace {

static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float));
static_assert(RayFan::kNothing == fan::kNoTriangle);

void copy(const Eigen::Vector3f& from, float (&to)[3]) { std::copy_n(from.data(), 3, to); }

/// Sets the tile's axes: "ahead" through the middle of its corner rays, "across" from the left corners to the right.
void set_axes(fan::Window& window, std::span<const Eigen::Vector3f> directions, std::size_t grid_columns,
              const Eigen::Matrix3f& R_TW) {
  const auto corner = [&](int row, int column) {
    return directions[(window.row + static_cast<std::size_t>(row)) * grid_columns + window.column +
                      static_cast<std::size_t>(column)];
  };
  const int row = window.rows - 1, column = window.columns - 1;
  const Eigen::Vector3f left = corner(0, 0) + corner(row, 0), right = corner(0, column) + corner(row, column);
  Eigen::Vector3f ahead = left + right;
  // Rays in all directions have no mean direction. Any axis will do: the kernel will reject such a tile.
  ahead = ahead.squaredNorm() > 0.0F ? ahead.normalized() : corner(0, 0);
  Eigen::Vector3f across = right - left;
  across -= across.dot(ahead) * ahead;
  across = across.squaredNorm() > 1e-8F ? across.normalized() : ahead.unitOrthogonal();
  const std::array<Eigen::Vector3f, 3> axes = {across, ahead.cross(across), ahead};
  for (std::size_t k = 0; k < 3; ++k) {
    copy(axes[k], window.axes_W[k]);
    copy(R_TW * axes[k], window.axes_T[k]);
  }
}

}  // namespace

struct RayFan::Impl {
  fan::Tree tree;
  bool (*trace_tile)(const fan::Job& job, const fan::Window& window);
};

RayFan::RayFan(const TriangleMesh& mesh, Width width)
    : impl_(new Impl{fan::build_tree(mesh), width == Width::widest && __builtin_cpu_supports("avx2")
                                                ? &fan::trace_tile_avx2
                                                : &fan::trace_tile_sse2}) {}
RayFan::~RayFan() = default;
RayFan::RayFan(RayFan&&) noexcept = default;
RayFan& RayFan::operator=(RayFan&&) noexcept = default;

void RayFan::trace(const Eigen::Vector3f& origin, std::span<const Eigen::Vector3f> directions, std::size_t columns,
                   std::span<const float> reaches, std::span<std::uint32_t> triangles) const {
  const fan::Tree& tree = impl_->tree;
  if (tree.branches.empty()) {
    std::ranges::fill(triangles, kNothing);
    return;
  }
  fan::Job job{};
  job.branches = tree.branches.data();
  job.leaves = tree.leaves.data();
  copy(origin, job.origin_W);
  copy(tree.R_TW * origin, job.origin_T);
  job.slack = 1e-6F * (tree.largest_coordinate + origin.cwiseAbs().maxCoeff());
  job.columns = columns;
  job.directions = directions.empty() ? nullptr : directions.front().data();
  job.reaches = reaches.data();
  job.triangles = triangles.data();

  const auto trace_window = [&](std::size_t row, std::size_t column, std::size_t rows, std::size_t across) {
    fan::Window window{};
    window.row = row;
    window.column = column;
    window.rows = static_cast<int>(rows);
    window.columns = static_cast<int>(across);
    set_axes(window, directions, columns, tree.R_TW);
    return impl_->trace_tile(job, window);
  };
  const std::size_t rows = directions.size() / columns;
  for (std::size_t row = 0; row < rows; row += fan::kTileRows) {
    for (std::size_t column = 0; column < columns; column += fan::kTileColumns) {
      const std::size_t height = std::min<std::size_t>(fan::kTileRows, rows - row);
      const std::size_t width = std::min<std::size_t>(fan::kTileColumns, columns - column);
      if (trace_window(row, column, height, width)) continue;
      for (std::size_t i = 0; i < height * width; ++i) trace_window(row + i / width, column + i % width, 1, 1);
    }
  }
}

}  // namespace skein::sim
