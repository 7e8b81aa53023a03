// The kernel of RayFan: a tile of rays traverses the search tree (docs/decisions/0007-fan-of-rays.md).
// Only ray_fan_sse2.cpp and ray_fan_avx2.cpp include this file, and compile it for their instruction set. It uses only
// built-in types: an inline function of a library, compiled for AVX2 here, might be linked into code that also runs on
// CPUs without AVX2.
// Frames: W world, T the tree's axes. A tile has axes of its own: across it, along its columns, and ahead.
#pragma once

#include "sight/ray_fan_leaf.hpp"

namespace skein::sim::fan {
namespace {

struct Entry {
  std::int32_t link;  ///< as Branch::children
  float depth;        ///< at which its box begins, along the tile's "ahead" axis [m]
  Rect rect;          ///< rays that may hit it
};

struct Stack {
  Entry entries[kStackSize];
  int size;
};

/// Prefetches the memory of a branch or leaf.
inline void fetch(const Job& job, std::int32_t link) {
  const char* memory =
      link < 0 ? reinterpret_cast<const char*>(&job.leaves[~link]) : reinterpret_cast<const char*>(&job.branches[link]);
  constexpr std::size_t kLine = 64;
  for (std::size_t at = 0; at < sizeof(Branch); at += kLine) __builtin_prefetch(memory + at);
}

/// Pushes those children of a branch that rays of the rectangle may hit, the nearest on top.
inline void push_children(const Tile& tile, const Job& job, const Branch& branch, const Rect& rect, Stack& stack) {
  const Vector8 centre = load3(branch.centre_T) - tile.origin_T, half = load3(branch.half_T);
  const Float8 across = dot(tile.axes_T[0], centre), width = dot(tile.spans_T[0], half) + tile.slack;
  const Float8 along = dot(tile.axes_T[1], centre), height = dot(tile.spans_T[1], half) + tile.slack;
  const Float8 ahead = dot(tile.axes_T[2], centre), depth = dot(tile.spans_T[2], half) + tile.slack;
  const Float8 front = ahead - depth, back = ahead + depth;
  // If a box contains the tile's origin or lies beside it, only its part ahead counts.
  const Float8 by_front = all(1.0F) / larger(front, all(1e-6F)), by_back = all(1.0F) / back;
  const auto lowest = [&](Float8 low) { return smaller(low * by_front, low * by_back); };
  const auto highest = [&](Float8 high) { return larger(high * by_front, high * by_back); };
  const Indices columns =
      indices(tile.columns, lowest(across - width), highest(across + width), rect.column0, rect.column1);
  const Indices rows = indices(tile.rows, lowest(along - height), highest(along + height), rect.row0, rect.row1);
  unsigned met = bits((back > all(0.0F)) & (columns.past_last > columns.first) & (rows.past_last > rows.first));
  alignas(32) float fronts[kLanes];
  alignas(32) int column0[kLanes], column1[kLanes], row0[kLanes], row1[kLanes];
  store(fronts, front);
  store_whole(column0, columns.first);
  store_whole(column1, columns.past_last);
  store_whole(row0, rows.first);
  store_whole(row1, rows.past_last);
  const int bottom = stack.size;
  for (; met != 0; met &= met - 1) {
    const int lane = __builtin_ctz(met);
    fetch(job, branch.children[lane]);
    int at = stack.size++;
    for (; at > bottom && stack.entries[at - 1].depth < fronts[lane]; --at) stack.entries[at] = stack.entries[at - 1];
    stack.entries[at] = {
        branch.children[lane], fronts[lane], {column0[lane], column1[lane] - 1, row0[lane], row1[lane] - 1}};
  }
}

inline void search(Tile& tile, const Job& job, const Rect& rays) {
  Stack stack;
  stack.size = 1;
  stack.entries[0] = {0, 0.0F, rays};
  while (stack.size > 0) {
    const Entry entry = stack.entries[--stack.size];
    if (entry.link < 0) {
      try_leaf(tile, job.leaves[~entry.link], entry.rect, entry.depth);
    } else if (!hidden(tile, entry.rect, entry.depth)) {
      push_children(tile, job, job.branches[entry.link], entry.rect, stack);
    }
  }
}

inline bool trace_tile(const Job& job, const Window& window) {
  Tile tile;
  gather(job, window, tile);
  if (!arrange(job, window, tile)) return false;
  search(tile, job, {0, window.columns - 1, 0, window.rows - 1});
  for (int row = 0; row < window.rows; ++row) {
    std::uint32_t* triangles =
        job.triangles + (window.row + static_cast<std::size_t>(row)) * job.columns + window.column;
    for (int column = 0; column < window.columns; ++column) triangles[column] = tile.triangle[row * kLanes + column];
  }
  return true;
}

}  // namespace
}  // namespace skein::sim::fan
