// Tests the triangles of a leaf against the rays of a tile. Part of ray_fan_kernel.hpp: see its first lines.
#pragma once

#include "sight/ray_fan_tile.hpp"

namespace skein::sim::fan {
namespace {

/// Eight triangles as seen from the origin.
struct Triangles {
  Vector8 corners[3];  ///< relative to the origin, in W
  Float8 depths[3];    ///< of the corners, along the tile's "ahead" axis
  Float8 front, back;  ///< the least and the greatest depth
};

/// Planes of eight triangles. The origin and an edge span a plane; a ray hits the triangle if it lies on the inner side
/// of all three. Two triangles that share an edge compute its plane from the same numbers with opposite sign, to the
/// last bit, so no ray passes between them. The margin covers rounding errors at corners, where several planes meet.
struct Planes {
  Vector8 edges[3];
  Float8 margins[3];
  Vector8 nearness;  ///< plane of the triangle: its scalar product with a ray is the nearness, 1 / depth
  Float8 least_nearness, most_nearness;
  Float8 seen;  ///< mask: not degenerate, not edge-on, and not behind the origin
};

inline Triangles triangles_of(const Leaf& leaf, const Tile& tile) {
  Triangles triangles;
  for (int k = 0; k < 3; ++k) {
    triangles.corners[k] = load3(leaf.corners_W[k]) - tile.origin_W;
    triangles.depths[k] = dot(triangles.corners[k], tile.axes_W[2]);
  }
  const auto& depths = triangles.depths;
  triangles.front = smaller(smaller(depths[0], depths[1]), depths[2]);
  triangles.back = larger(larger(depths[0], depths[1]), depths[2]);
  return triangles;
}

inline Planes planes_of(const Triangles& triangles) {
  const auto& p = triangles.corners;
  const Vector8 normal = cross(p[1] - p[0], p[2] - p[0]);
  const Float8 volume = dot(normal, p[0]);
  // Makes the inner sides of the edges positive, from whichever side the origin sees the triangle.
  const Float8 turn = sign_of(volume);
  Planes planes;
  for (int k = 0; k < 3; ++k) {
    const Vector8 &a = p[k], &b = p[(k + 1) % 3];
    // Twice a x b, but without cancellation if the edge is short, and antisymmetric to the last bit.
    const Vector8 sum = a + b, along = b - a;
    planes.edges[k] = cross(sum, along) ^ turn;
    planes.margins[k] = all(2.4e-7F) * extent(sum) * extent(along);
  }
  // Triangles that are exactly edge-on, degenerate or behind get a nearness of 0, so that no ray hits them.
  const Float8 seen = (magnitude(volume) > all(1e-9F) * extent(normal) * extent(p[0])) & (triangles.back > all(0.0F));
  planes.seen = seen;
  planes.nearness = normal * ((all(1.0F) / volume) & seen);
  // If the triangle is almost edge-on, its plane is ill-conditioned: the depths of its corners bound the nearness.
  planes.least_nearness = (all(1.0F) / larger(triangles.back, all(1e-9F))) & seen;
  planes.most_nearness = (all(1.0F) / larger(triangles.front, all(1e-9F))) & seen;
  return planes;
}

/// Negative in the lanes in which the ray misses the triangle.
inline Float8 inner_side(const Planes& planes, const Vector8& d) {
  return smaller(smaller(dot(planes.edges[0], d) + planes.margins[0], dot(planes.edges[1], d) + planes.margins[1]),
                 dot(planes.edges[2], d) + planes.margins[2]);
}

inline Float8 nearness_of(const Planes& planes, const Vector8& d) {
  return larger(planes.least_nearness, smaller(planes.most_nearness, dot(planes.nearness, d)));
}

/// Stores the planes of eight triangles; of() returns those of one triangle, repeated in all lanes, to test eight rays.
struct StoredPlanes {
  alignas(32) float lanes[17][kLanes];

  explicit StoredPlanes(const Planes& planes) {
    for (int k = 0; k < 3; ++k) {
      put(3 * k, planes.edges[k]);
      store(lanes[9 + k], planes.margins[k]);
    }
    put(12, planes.nearness);
    store(lanes[15], planes.least_nearness);
    store(lanes[16], planes.most_nearness);
  }
  Planes of(int lane) const {
    const auto at = [&](int i) { return all(lanes[i][lane]); };
    return {{{at(0), at(1), at(2)}, {at(3), at(4), at(5)}, {at(6), at(7), at(8)}},
            {at(9), at(10), at(11)},
            {at(12), at(13), at(14)},
            at(15),
            at(16),
            all(0.0F)};
  }

 private:
  void put(int i, const Vector8& v) {
    store(lanes[i], v.x);
    store(lanes[i + 1], v.y);
    store(lanes[i + 2], v.z);
  }
};

/// The rays of a rectangle that may hit each of eight triangles.
struct Shadows {
  Indices columns, rows;
  unsigned some;  ///< bit mask of the triangles that any ray may hit
};
inline Shadows shadows_of(const Triangles& triangles, const Tile& tile, const Rect& rect) {
  Float8 low[2], high[2];
  for (int k = 0; k < 3; ++k) {
    const Float8 by_depth = all(1.0F) / triangles.depths[k];
    for (int axis = 0; axis < 2; ++axis) {
      const Float8 slope = dot(triangles.corners[k], tile.axes_W[axis]) * by_depth;
      low[axis] = k == 0 ? slope : smaller(low[axis], slope);
      high[axis] = k == 0 ? slope : larger(high[axis], slope);
    }
  }
  // If a triangle begins beside or behind the origin, its slopes are undefined or too steep: any ray may hit it.
  const Float8 ahead = triangles.front > all(1e-3F) * triangles.back, any = without(all(1e9F), ahead);
  const auto lowest = [&](int axis) { return (low[axis] & ahead) - any; };
  const auto highest = [&](int axis) { return (high[axis] & ahead) + any; };
  const Indices columns = indices(tile.columns, lowest(0), highest(0), rect.column0, rect.column1);
  const Indices rows = indices(tile.rows, lowest(1), highest(1), rect.row0, rect.row1);
  return {columns, rows, bits((columns.past_last > columns.first) & (rows.past_last > rows.first))};
}

/// Tests all eight triangles at once, ray by ray: faster for few rays.
inline void try_by_rays(Tile& tile, const Leaf& leaf, const Planes& planes, const Rect& rect, float depth) {
  for (int row = rect.row0; row <= rect.row1; ++row) {
    for (int column = rect.column0; column <= rect.column1; ++column) {
      const int ray = row * kLanes + column;
      if (tile.nearness[ray] * depth >= 1.0F) continue;
      const Vector8 d{all(tile.x[ray]), all(tile.y[ray]), all(tile.z[ray])};
      unsigned met = bits(inner_side(planes, d) >= all(0.0F));
      if (met == 0) continue;
      const Float8 nearness = nearness_of(planes, d);
      met &= bits(nearness > all(tile.nearness[ray]));
      alignas(32) float lanes[kLanes];
      store(lanes, nearness);
      for (; met != 0; met &= met - 1) {
        const int lane = __builtin_ctz(met);
        if (!(lanes[lane] > tile.nearness[ray])) continue;
        tile.nearness[ray] = lanes[lane];
        tile.triangle[ray] = leaf.triangles[lane];
      }
    }
  }
}

/// Tests the eight rays of a row at once, triangle by triangle: faster for many rays.
inline void try_by_triangles(Tile& tile, const Leaf& leaf, const Planes& planes, const Shadows& shadows) {
  const StoredPlanes stored(planes);
  alignas(32) int row0[kLanes], row1[kLanes];
  store_whole(row0, shadows.rows.first);
  store_whole(row1, shadows.rows.past_last);
  for (unsigned rest = bits(planes.seen) & shadows.some; rest != 0; rest &= rest - 1) {
    const int lane = __builtin_ctz(rest);
    const Planes one = stored.of(lane);
    for (int row = row0[lane]; row < row1[lane]; ++row) {
      const int ray = row * kLanes;
      const Vector8 d{load(&tile.x[ray]), load(&tile.y[ray]), load(&tile.z[ray])};
      const Float8 inner = inner_side(one, d) >= all(0.0F);
      if (bits(inner) == 0) continue;
      const Float8 before = load(&tile.nearness[ray]), nearness = nearness_of(one, d);
      const Float8 nearer = inner & (nearness > before);
      store(&tile.nearness[ray], (nearness & nearer) + without(before, nearer));
      for (unsigned met = bits(nearer); met != 0; met &= met - 1) {
        tile.triangle[ray + __builtin_ctz(met)] = leaf.triangles[lane];
      }
    }
  }
}

/// Tests the triangles of a leaf against the rays of a rectangle.   @param depth  at which the leaf's box begins.
inline void try_leaf(Tile& tile, const Leaf& leaf, const Rect& rect, float depth) {
  constexpr int kFewRays = 16;  // at which both ways cost the same (measured)
  if (hidden(tile, rect, depth)) return;
  const Triangles triangles = triangles_of(leaf, tile);
  if ((rect.column1 - rect.column0 + 1) * (rect.row1 - rect.row0 + 1) <= kFewRays) {
    try_by_rays(tile, leaf, planes_of(triangles), rect, depth);
    return;
  }
  const Shadows shadows = shadows_of(triangles, tile, rect);
  if (shadows.some != 0) try_by_triangles(tile, leaf, planes_of(triangles), shadows);
}

}  // namespace
}  // namespace skein::sim::fan
