// A tile of RayFan: neighbouring rays from one point. The functions find rays that may hit a box or a triangle.
// Part of ray_fan_kernel.hpp: see its first lines.
#pragma once

#include "sight/float8.hpp"
#include "sight/ray_fan_job.hpp"

namespace skein::sim::fan {
namespace {

constexpr int kRays = kTileRows * kTileColumns;
static_assert(kTileColumns == kLanes, "a row of a tile fills one vector");

constexpr float min(float a, float b) { return b < a ? b : a; }
constexpr float max(float a, float b) { return b > a ? b : a; }
constexpr int min(int a, int b) { return b < a ? b : a; }

/// A rectangle of rays of a tile: first and last column, first and last row.
struct Rect {
  int column0, column1, row0, row1;
};

/// Converts slopes to indices of the tile's columns or rows: index = slope * scale + offset. The offset `to_first`
/// gives the first index of a range of slopes, and `to_past_last` the index past its last. Both include a margin for
/// rays that deviate from a regular grid, and for rounding errors.
struct Ruler {
  Float8 scale, to_first, to_past_last;
};

/// Neighbouring rays. Each direction is scaled so that its component along the tile's "ahead" axis is 1.
struct Tile {
  alignas(32) float x[kRays], y[kRays], z[kRays];  ///< directions in W
  alignas(32) float nearness[kRays];               ///< 1 / depth of the first hit so far, or of the ray's end
  std::uint32_t triangle[kRays];                   ///< the first one that each ray hits so far, or kNoTriangle
  Vector8 origin_W, origin_T;
  Vector8 axes_W[3], axes_T[3];  ///< across, along, ahead (ray_fan_kernel.hpp)
  Vector8 spans_T[3];            ///< magnitudes of the components of axes_T
  Float8 slack;
  Ruler columns, rows;
};

inline Vector8 spread(const float (&v)[3]) { return {all(v[0]), all(v[1]), all(v[2])}; }
inline Vector8 load3(const float (&rows)[3][kLanes]) { return {load(rows[0]), load(rows[1]), load(rows[2])}; }
inline Float8 column_numbers() {
  alignas(32) static constexpr float kNumbers[kLanes] = {0, 1, 2, 3, 4, 5, 6, 7};
  return load(kNumbers);
}
inline float least(Float8 a) {
  alignas(32) float lanes[kLanes];
  store(lanes, a);
  float result = lanes[0];
  for (const float lane : lanes) result = min(result, lane);
  return result;
}
inline float most(Float8 a) { return -least(all(0.0F) - a); }

/// The columns of a rectangle as a bit mask.
inline unsigned columns_of(const Rect& rect) { return (2U << rect.column1) - (1U << rect.column0); }

/// Whether each ray of a rectangle hits a triangle, or ends, at a smaller depth than `depth`.
inline bool hidden(const Tile& tile, const Rect& rect, float depth) {
  if (depth <= 0.0F) return false;
  Float8 farthest = load(&tile.nearness[rect.row0 * kLanes]);
  for (int row = rect.row0 + 1; row <= rect.row1; ++row) {
    farthest = smaller(farthest, load(&tile.nearness[row * kLanes]));
  }
  return (bits(all(1.0F) > farthest * all(depth)) & columns_of(rect)) == 0;
}

/// The range of indices whose rays may have a slope between two values. Empty if past_last <= first.
struct Indices {
  Float8 first, past_last;
};
inline Indices indices(const Ruler& ruler, Float8 low, Float8 high, int first, int last) {
  const Float8 from = low * ruler.scale + ruler.to_first, to = high * ruler.scale + ruler.to_past_last;
  return {truncated(smaller(larger(from, all(static_cast<float>(first))), all(1e6F))),
          truncated(larger(smaller(to, all(static_cast<float>(last + 1))), all(0.0F)))};
}

/// Fits a ruler to slopes that grow with the index.
/// @param last  the largest index.   @param index_of  returns the true indices of a row of rays.
/// @param deviation  receives the largest deviation of a slope from the ruler, as a number of index steps.
Ruler fit_ruler(const float (&slopes)[kRays], int last, auto index_of, float& deviation) {
  Float8 low = load(slopes), high = low;
  for (int i = kLanes; i < kRays; i += kLanes) {
    low = smaller(low, load(&slopes[i]));
    high = larger(high, load(&slopes[i]));
  }
  const float start = least(low);
  const float scale = static_cast<float>(last > 1 ? last : 1) / max(most(high) - start, 1e-4F);
  Float8 deviations = all(0.0F);
  for (int row = 0; row < kTileRows; ++row) {
    const Float8 index = (load(&slopes[row * kLanes]) - all(start)) * all(scale);
    deviations = larger(deviations, magnitude(index - index_of(row)));
  }
  deviation = most(deviations);
  const float margin = deviation + 1e-3F + 1e-6F * scale;
  return {all(scale), all(1.0F - margin - start * scale), all(1.0F + margin - start * scale)};
}

/// Copies the rays into the tile; a tile at the edge of the grid repeats its last rays. `nearness` receives their
/// lengths, which arrange() converts.
inline void gather(const Job& job, const Window& window, Tile& tile) {
  for (int row = 0; row < kTileRows; ++row) {
    const std::size_t first =
        (window.row + static_cast<std::size_t>(min(row, window.rows - 1))) * job.columns + window.column;
    const float* directions = job.directions + 3 * first;
    const float* reaches = job.reaches + first;
    for (int column = 0; column < kTileColumns; ++column) {
      const int from = min(column, window.columns - 1), ray = row * kLanes + column;
      tile.x[ray] = directions[3 * from];
      tile.y[ray] = directions[3 * from + 1];
      tile.z[ray] = directions[3 * from + 2];
      tile.nearness[ray] = reaches[from];
      tile.triangle[ray] = kNoTriangle;
    }
  }
}

/// Scales the rays and fits the rulers.   @returns false if the rays spread too far, or are too irregular, for a tile.
inline bool arrange(const Job& job, const Window& window, Tile& tile) {
  constexpr float kLeastAhead = 0.5F, kMostDeviation = 1.5F;
  alignas(32) float across[kRays], along[kRays];
  tile.origin_W = spread(job.origin_W);
  tile.origin_T = spread(job.origin_T);
  tile.slack = all(job.slack);
  for (int k = 0; k < 3; ++k) {
    tile.axes_W[k] = spread(window.axes_W[k]);
    tile.axes_T[k] = spread(window.axes_T[k]);
    tile.spans_T[k] = {magnitude(tile.axes_T[k].x), magnitude(tile.axes_T[k].y), magnitude(tile.axes_T[k].z)};
  }
  Float8 narrowest = all(1.0F);
  for (int i = 0; i < kRays; i += kLanes) {
    const Vector8 d{load(&tile.x[i]), load(&tile.y[i]), load(&tile.z[i])};
    const Float8 share = dot(d, tile.axes_W[2]);
    narrowest = smaller(narrowest, share);
    const Float8 stretch = all(1.0F) / share;
    store(&tile.x[i], d.x * stretch);
    store(&tile.y[i], d.y * stretch);
    store(&tile.z[i], d.z * stretch);
    store(&tile.nearness[i], stretch / load(&tile.nearness[i]));
    store(&across[i], dot(d, tile.axes_W[0]) * stretch);
    store(&along[i], dot(d, tile.axes_W[1]) * stretch);
  }
  if (!(least(narrowest) > kLeastAhead)) return false;
  const int last_column = window.columns - 1, last_row = window.rows - 1;
  const Float8 column_index = smaller(column_numbers(), all(static_cast<float>(last_column)));
  const auto row_index = [last_row](int row) { return all(static_cast<float>(min(row, last_row))); };
  float deviation[2];
  tile.columns = fit_ruler(
      across, last_column, [column_index](int) { return column_index; }, deviation[0]);
  tile.rows = fit_ruler(along, last_row, row_index, deviation[1]);
  return max(deviation[0], deviation[1]) <= kMostDeviation;
}

}  // namespace
}  // namespace skein::sim::fan
