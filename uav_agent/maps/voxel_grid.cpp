#include "uav_agent/maps/voxel_grid.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "uav_agent/api/fnv_hash.hpp"

namespace skein::agent {
namespace {

constexpr double kGrowth = 1.1;             ///< of cubes that would be too many, step by step; chosen
constexpr std::size_t kUsualInChunk = 512;  ///< chosen; voxel_grid.hpp
constexpr std::size_t kMostInChunk = std::numeric_limits<std::uint16_t>::max();  ///< a chunk's length has two bytes
constexpr std::uint8_t kPlain = 0, kRuns = 1;                                    ///< encoding of a chunk
constexpr std::size_t kLongestRun = std::numeric_limits<std::uint8_t>::max();    ///< a run's length has one byte
/// Greatest valid value of the state bits, which are the numbers of VoxelState: two states merge to the greater one.
constexpr auto kHighestState = static_cast<std::uint8_t>(VoxelState::occupied);
constexpr double kLeastEdges = 1e-9;  ///< numeric: rounded up to one cube

/// Edges of a grid, in cubes.
Vector3d edges_of(const Vector3d& size_m, double voxel_m) { return (size_m / voxel_m).array().max(kLeastEdges).ceil(); }

/// The box of an operational volume: its lowest corner in W, and its size.
std::pair<Vector3d, Vector3d> operational_box(const std::vector<OrientedBox>& boxes,
                                              const std::vector<Vector3d>& points_W, double margin_m, double lowest_m,
                                              double voxel_m) {
  Eigen::AlignedBox3d all = extent_of(boxes);
  for (const Vector3d& p : points_W) all.extend(p);
  if (all.isEmpty()) all.extend(Vector3d::Zero());
  Vector3d lo = all.min().array() - margin_m;
  Vector3d size = (all.max().array() + margin_m).matrix() - lo;
  const double cut = std::max(0.0, lowest_m - lo.z());
  lo.z() += cut;
  size.z() = std::max(size.z() - cut, voxel_m);
  return {lo, size};
}

}  // namespace

VoxelGrid::VoxelGrid(const Isometry3d& X_WG, const Vector3d& size_m, double voxel_m,
                     std::optional<std::size_t> chunk_voxels)
    : X_WG_(X_WG), X_GW_(X_WG.inverse()), voxel_m_(voxel_m) {
  const Vector3d edges = edges_of(size_m, voxel_m);
  const bool chunks_can_be = !chunk_voxels || (*chunk_voxels > 0 && *chunk_voxels <= kMostInChunk);
  if (!(voxel_m > 0.0) || !chunks_can_be || !edges.allFinite() || edges.prod() > kMostVoxels) {
    throw std::invalid_argument("a voxel grid of this size cannot be");
  }
  dims_ = edges.cast<int>();
  voxels_.assign(static_cast<std::size_t>(dims_.prod()), 0);
  const auto parts = [this](std::size_t size) { return (voxels_.size() + size - 1) / size; };
  chunk_voxels_ = chunk_voxels.value_or(std::max(kUsualInChunk, parts(kMostChunks)));
  chunk_revision_.assign(parts(chunk_voxels_), 0);
  chunk_hash_.assign(chunk_revision_.size(), {0, 0});
}

std::uint32_t VoxelGrid::fingerprint() const {
  FnvHash hash;
  const auto mix = [&hash](double value) {
    constexpr double kMillimetres = 1000.0;  // format: values are compared in thousandths
    const auto rounded = static_cast<std::uint32_t>(std::lround(value * kMillimetres));
    for (std::size_t i = 0; i < sizeof(rounded); ++i) hash.add(rounded >> (8 * i) & 0xFF);
  };
  for (int i = 0; i < 3; ++i) mix(dims_[i]);
  for (int i = 0; i < 3; ++i) mix(X_WG_.translation()[i]);
  for (int i = 0; i < 3; ++i) mix(X_WG_.linear()(i, 0));
  mix(voxel_m_);
  mix(static_cast<double>(chunk_voxels_));
  return hash.value();
}

std::optional<VoxelGrid::Id> VoxelGrid::at(const Cell& cell) const {
  if ((cell.array() < 0).any() || (cell.array() >= dims_.array()).any()) return std::nullopt;
  return static_cast<Id>((cell.z() * dims_.y() + cell.y()) * dims_.x() + cell.x());
}

std::optional<VoxelGrid::Id> VoxelGrid::at(const Vector3d& p_W) const {
  const Vector3d p_G = X_GW_ * p_W / voxel_m_;
  // Checked before the conversion to integers, which far points would overflow.
  if (!(p_G.array() >= 0.0).all() || !(p_G.array() < dims_.cast<double>().array()).all()) return std::nullopt;
  return at(Cell(p_G.cast<int>()));
}

VoxelGrid::Cell VoxelGrid::cell(Id id) const {
  const int i = static_cast<int>(id);
  return {i % dims_.x(), i / dims_.x() % dims_.y(), i / (dims_.x() * dims_.y())};
}

std::pair<VoxelGrid::Cell, VoxelGrid::Cell> VoxelGrid::cells_within(const Vector3d& middle_W,
                                                                    double half_edge_m) const {
  const Vector3d p = X_GW_ * middle_W / voxel_m_;
  const Vector3d reach = X_GW_.linear().cwiseAbs() * Vector3d::Constant(half_edge_m / voxel_m_);
  const Eigen::Array3d most = dims_.cast<double>();
  return {(p - reach).array().floor().max(0.0).min(most).cast<int>(),
          (p + reach).array().floor().max(-1.0).min(most - 1.0).cast<int>()};
}

Vector3d VoxelGrid::centre_W(Id id) const {
  return X_WG_ * ((cell(id).cast<double>() + Vector3d::Constant(0.5)) * voxel_m_);
}

std::optional<VoxelGrid::Id> VoxelGrid::neighbour(Id id, int face) const {
  const int axis = face / 2;
  const bool up = face % 2 == 0;
  const int stride = axis == 0 ? 1 : axis == 1 ? dims_.x() : dims_.x() * dims_.y();
  const int along = static_cast<int>(id) / stride % dims_[axis];
  if (along == (up ? dims_[axis] - 1 : 0)) return std::nullopt;
  return static_cast<Id>(static_cast<int>(id) + (up ? stride : -stride));
}

Vector3d VoxelGrid::normal_W(int face) const { return (face % 2 == 0 ? 1.0 : -1.0) * X_WG_.linear().col(face / 2); }

bool VoxelGrid::set(Id id, std::uint8_t voxel) {
  if (voxels_[id] == voxel) return false;
  if ((voxels_[id] ^ voxel) & kStateBits) changed_.push_back(id);
  voxels_[id] = voxel;
  chunk_revision_[id / chunk_voxels_] = ++revision_;
  return true;
}

bool VoxelGrid::raise(Id id, VoxelState to) {
  const auto level = static_cast<std::uint8_t>(std::max(state(id), to));
  return set(id, static_cast<std::uint8_t>((voxels_[id] & ~kStateBits) | level));
}

bool VoxelGrid::mark(Id id, int face) { return set(id, static_cast<std::uint8_t>(voxels_[id] | mark_bit(face))); }

std::vector<VoxelGrid::Id> VoxelGrid::take_changed() { return std::exchange(changed_, {}); }

template <class Visit>
void VoxelGrid::walk(const Vector3d& a_W, const Vector3d& b_W, Visit&& visit) const {
  const Vector3d a = X_GW_ * a_W / voxel_m_, b = X_GW_ * b_W / voxel_m_, d = b - a;
  // Clips the segment to the grid first, so that parts far outside cost no time.
  double enter = 0.0, leave = 1.0;
  for (int i = 0; i < 3; ++i) {
    if (d[i] == 0.0) {
      if (a[i] < 0.0 || a[i] >= dims_[i]) return;
      continue;
    }
    const double t0 = -a[i] / d[i], t1 = (dims_[i] - a[i]) / d[i];
    enter = std::max(enter, std::min(t0, t1));
    leave = std::min(leave, std::max(t0, t1));
  }
  if (enter > leave) return;
  const Vector3d first = a + enter * d;
  Cell c = first.array().floor().cast<int>().max(0).min(dims_.array() - 1);
  Cell step;
  Vector3d next, between;
  for (int i = 0; i < 3; ++i) {
    step[i] = d[i] > 0.0 ? 1 : -1;
    between[i] = d[i] == 0.0 ? std::numeric_limits<double>::infinity() : std::abs(1.0 / d[i]);
    next[i] = d[i] == 0.0 ? std::numeric_limits<double>::infinity() : (c[i] + (step[i] > 0 ? 1 : 0) - a[i]) / d[i];
  }
  const Cell stride = step.cwiseProduct(Cell(1, dims_.x(), dims_.x() * dims_.y()));
  for (int id = static_cast<int>(*at(c)); visit(static_cast<Id>(id));) {
    int axis = next[1] < next[0] ? 1 : 0;
    if (next[2] < next[axis]) axis = 2;
    c[axis] += step[axis];
    if (next[axis] > leave || c[axis] < 0 || c[axis] >= dims_[axis]) return;
    id += stride[axis];
    next[axis] += between[axis];
  }
}

void VoxelGrid::along(const Vector3d& a_W, const Vector3d& b_W, const std::function<bool(Id)>& visit) const {
  walk(a_W, b_W, visit);
}

bool VoxelGrid::sees(const Vector3d& a_W, const Vector3d& b_W) const {
  const auto from = at(a_W), to = at(b_W);
  bool clear = true;
  walk(a_W, b_W, [&](Id id) {
    clear = state(id) != VoxelState::occupied || id == from || id == to;
    return clear;
  });
  return clear;
}

std::pair<VoxelGrid::Id, VoxelGrid::Id> VoxelGrid::chunk_range(std::size_t chunk) const {
  const std::size_t first = chunk * chunk_voxels_;
  return {static_cast<Id>(first), static_cast<Id>(std::min(first + chunk_voxels_, voxels_.size()))};
}

std::uint16_t VoxelGrid::chunk_hash(std::size_t chunk) const {
  auto& [revision, hash] = chunk_hash_[chunk];
  if (revision == chunk_revision_[chunk]) return hash;
  FnvHash content;
  const auto [begin, end] = chunk_range(chunk);
  for (Id id = begin; id < end; ++id) content.add(voxels_[id]);
  revision = chunk_revision_[chunk];
  hash = std::max<std::uint16_t>(1, content.folded());
  return hash;
}

void VoxelGrid::write_chunk(std::size_t chunk, PayloadWriter& writer) const {
  const auto [begin, end] = chunk_range(chunk);
  std::vector<std::uint8_t> runs;
  for (Id id = begin; id < end;) {
    Id last = id;
    while (last < end && voxels_[last] == voxels_[id] && last - id < kLongestRun) ++last;
    runs.push_back(static_cast<std::uint8_t>(last - id));
    runs.push_back(voxels_[id]);
    id = last;
  }
  const std::span<const std::uint8_t> plain(voxels_.data() + begin, end - begin);
  const bool as_runs = runs.size() < plain.size();
  writer.u8(as_runs ? kRuns : kPlain);
  writer.u16(static_cast<std::uint16_t>(as_runs ? runs.size() : plain.size()));
  writer.bytes(as_runs ? runs : plain);
}

bool VoxelGrid::merge_chunk(std::size_t chunk, PayloadReader& reader) {
  const std::uint8_t kind = reader.u8();
  const auto bytes = reader.bytes(reader.u16());
  if (!reader.ok() || chunk >= chunks() || kind > kRuns) return false;
  const auto [begin, end] = chunk_range(chunk);
  std::vector<std::uint8_t> theirs;
  if (kind == kPlain) {
    theirs.assign(bytes.begin(), bytes.end());
  } else {
    for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) theirs.insert(theirs.end(), bytes[i], bytes[i + 1]);
  }
  const bool sound = theirs.size() == end - begin && std::ranges::none_of(theirs, [](std::uint8_t voxel) {
                       return (voxel & kStateBits) > kHighestState;
                     });
  if (!sound) return false;
  for (Id id = begin; id < end; ++id) {
    const std::uint8_t voxel = theirs[id - begin];
    const int level = std::max(voxels_[id] & kStateBits, voxel & kStateBits);
    set(id, static_cast<std::uint8_t>(((voxels_[id] | voxel) & ~kStateBits) | level));
  }
  return true;
}

void fill_boxes(const std::vector<OrientedBox>& boxes, VoxelGrid& grid) {
  for (VoxelGrid::Id id = 0; id < grid.count(); ++id) {
    const Vector3d centre = grid.centre_W(id);
    const bool inside = std::ranges::any_of(boxes, [&](const OrientedBox& box) { return box.contains(centre); });
    if (inside) grid.raise(id, VoxelState::occupied);
  }
}

Eigen::AlignedBox3d extent_of(const std::vector<OrientedBox>& boxes) {
  Eigen::AlignedBox3d all;
  for (const OrientedBox& box : boxes) {
    const Vector3d half = box.R_WO.cwiseAbs() * (0.5 * box.size);
    all.extend(Vector3d(box.center - half));
    all.extend(Vector3d(box.center + half));
  }
  return all;
}

VoxelGrid operational_volume(const std::vector<OrientedBox>& boxes, const std::vector<Vector3d>& points_W,
                             double margin_m, double lowest_m, double voxel_m) {
  const auto [lo, size] = operational_box(boxes, points_W, margin_m, lowest_m, voxel_m);
  return {Isometry3d(Eigen::Translation3d(lo)), size, voxel_m};
}

Vector3d operational_size(const std::vector<OrientedBox>& boxes, const std::vector<Vector3d>& points_W, double margin_m,
                          double lowest_m, double voxel_m) {
  return operational_box(boxes, points_W, margin_m, lowest_m, voxel_m).second;
}

double fitting_voxel_m(double voxel_m, const std::function<Vector3d(double voxel_m)>& size_of) {
  const auto has_too_many = [&] {
    const double cubes = edges_of(size_of(voxel_m), voxel_m).prod();
    return std::isfinite(cubes) && cubes > VoxelGrid::kMostVoxels;
  };
  while (has_too_many()) voxel_m *= kGrowth;
  return voxel_m;
}

std::string coarse_voxels_text(double voxel_m, double fitting_m, const Vector3d& size_m) {
  constexpr double kMillion = 1e6;  // format of the text
  const double side_m = std::sqrt(VoxelGrid::kMostVoxels * std::pow(voxel_m, 3) / size_m.minCoeff());
  return fmt::format(
      "voxel_m is {:.3g} m instead of {:.3g} m: the map of {:.0f} x {:.0f} x {:.0f} m would have {:.0f} million cubes, "
      "and {:.0f} million are the most; with voxel_m={:.3g}, a map of {:.0f} x {:.0f} x {:.0f} m fits",
      fitting_m, voxel_m, size_m.x(), size_m.y(), size_m.z(), std::ceil(edges_of(size_m, voxel_m).prod() / kMillion),
      VoxelGrid::kMostVoxels / kMillion, voxel_m, std::floor(side_m), std::floor(side_m), size_m.minCoeff());
}

VoxelGrid limited_volume(const std::vector<OrientedBox>& boxes, double margin_m, double voxel_m, int max_voxels) {
  const Vector3d edges = extent_of(boxes).sizes().array() + 2.0 * margin_m;
  while ((edges / voxel_m).array().ceil().prod() > max_voxels) voxel_m *= kGrowth;
  return operational_volume(boxes, {}, margin_m, 0.0, voxel_m);
}

}  // namespace skein::agent
