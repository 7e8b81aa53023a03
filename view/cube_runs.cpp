#include "view/cube_runs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>

#include "core/files/octree_bytes.hpp"
#include "core/text/base64.hpp"
#include "process/json_text.hpp"
#include "view/look_order.hpp"

namespace skein::view {
namespace {

/// Edge of the largest leaf that an octree may have, in its smallest cells: no map of a flight has a larger one.
constexpr int kLargestLeaf = 256;
constexpr std::size_t kMostRows = 1'000'000;

auto row_of(const CubeRun& run) { return std::tuple(run.z, run.y); }

/// A sort key in the order of (z, y, x): one number compares faster than three. An octree has 2^16 cells on each axis.
constexpr auto place_in_order = [](const CubeRun& run) {
  constexpr int kBits = 21, kMiddle = 1 << (kBits - 1);
  return static_cast<std::uint64_t>(run.z + kMiddle) << 2 * kBits |
         static_cast<std::uint64_t>(run.y + kMiddle) << kBits | static_cast<std::uint64_t>(run.x + kMiddle);
};

/// Index on the grid of cubes twice as large.
int halved(int cube) { return cube >> 1; }

/// Collects the runs of an octree's leaves.
class LeafRows {
 public:
  LeafRows(double cell_m, int slice) : cell_m_(cell_m), slice_(slice) {}

  void add(const KnownCube& leaf) {
    const int edge = cells(leaf.edge_m);
    if (edge > kLargestLeaf) sound = false;
    if (!sound) return;
    const int x = cells(leaf.lowest_W.x()), y = cells(leaf.lowest_W.y()), z = cells(leaf.lowest_W.z());
    if (!leaf.occupied) {
      for (int j = 0; z <= slice_ && slice_ < z + edge && j < edge; ++j) free.push_back({x, y + j, slice_, edge});
    } else {
      for (int i = 0; i < edge * edge; ++i) occupied.push_back({x, y + i % edge, z + i / edge, edge});
    }
    sound = occupied.size() + free.size() <= kMostRows;
  }

  bool sound = true;
  std::vector<CubeRun> occupied, free;

 private:
  int cells(double metres) const { return static_cast<int>(std::lround(metres / cell_m_)); }

  const double cell_m_;
  const int slice_;
};

class Bytes {
 public:
  void add(unsigned value) {
    for (; value >= 128; value >>= 7) bytes_.push_back(static_cast<std::uint8_t>(value | 128U));
    bytes_.push_back(static_cast<std::uint8_t>(value));
  }
  /// Zigzag encoding: 0, -1, 1, -2, ... become 0, 1, 2, 3, ...
  void add_signed(int value) { add(static_cast<unsigned>(value) << 1 ^ static_cast<unsigned>(value >> 31)); }
  std::string text() const { return base64(bytes_); }

 private:
  std::vector<std::uint8_t> bytes_;
};

}  // namespace

std::vector<CubeRun> joined_runs(std::vector<CubeRun> runs) {
  std::ranges::sort(runs, {}, place_in_order);
  std::vector<CubeRun> joined;
  for (const CubeRun& run : runs) {
    CubeRun* const last = joined.empty() ? nullptr : &joined.back();
    if (last != nullptr && row_of(*last) == row_of(run) && run.x <= last->x + last->length) {
      last->length = std::max(last->length, run.x + run.length - last->x);
    } else {
      joined.push_back(run);
    }
  }
  return joined;
}

std::vector<CubeRun> coarser_runs(const std::vector<CubeRun>& runs) {
  std::vector<CubeRun> larger;
  larger.reserve(runs.size());
  for (const CubeRun& run : runs) {
    const int begin = halved(run.x), end = halved(run.x + run.length - 1) + 1;
    larger.push_back({begin, halved(run.y), halved(run.z), end - begin});
  }
  return joined_runs(std::move(larger));
}

std::optional<ShownMap> shown_map(std::string_view octree, double cell_m, double slice_m, std::size_t most_runs) {
  if (!(cell_m >= 1e-3 && cell_m <= 100.0) || !(std::abs(slice_m) < 1e5)) return std::nullopt;
  LeafRows rows(cell_m, static_cast<int>(std::floor(slice_m / cell_m)));
  if (!visit_octree(octree, cell_m, [&](const KnownCube& leaf) { rows.add(leaf); }) || !rows.sound) return std::nullopt;
  ShownMap map{cell_m, joined_runs(std::move(rows.occupied)), cell_m, slice_m, joined_runs(std::move(rows.free))};
  const std::size_t most = std::max(most_runs, kLeastRuns);
  for (; map.occupied.size() > most; map.cell_m *= 2.0) map.occupied = coarser_runs(map.occupied);
  for (; map.free.size() > most; map.slice_cell_m *= 2.0) map.free = coarser_runs(map.free);
  return map;
}

std::string packed(std::span<const CubeRun> runs) {
  Bytes bytes;
  CubeRun last{0, 0, 0, 0};
  for (const CubeRun& run : runs) {
    const bool same_row = row_of(run) == row_of(last) && run.x >= last.x + last.length;
    bytes.add(static_cast<unsigned>(run.length - 1) << 1 | (same_row ? 1U : 0U));
    if (same_row) {
      bytes.add(static_cast<unsigned>(run.x - last.x - last.length));
    } else {
      bytes.add_signed(run.z - last.z);
      bytes.add_signed(run.y - last.y);
      bytes.add_signed(run.x - last.x);
    }
    last = run;
  }
  return bytes.text();
}

std::string map_text(const std::string& uav, double time_s, const ShownMap& map, const std::string& kind) {
  const Json json = {{"n", map_cloud(uav)},
                     {"t", time_s},
                     {"kind", kind},
                     {"cell", map.cell_m},
                     {"steps", Json::array({{{"t", time_s}, {"runs", packed(map.occupied)}}})},
                     {"z", map.slice_m},
                     {"freeCell", map.slice_cell_m},
                     {"free", packed(map.free)}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string no_map_text(const std::string& uav, double time_s, const std::string& why) {
  const Json json = {{"n", map_cloud(uav)}, {"t", time_s}, {"none", why}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace skein::view
