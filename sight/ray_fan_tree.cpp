#include "sight/ray_fan_tree.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <span>
#include <utility>

#include "core/math/euler.hpp"

namespace skein::sim::fan {
namespace {

using Box = Eigen::AlignedBox3f;

/// Additional pieces from cutting long triangles, at most, as a share of the number of triangles.
constexpr double kExtraPieces = 0.2;
constexpr int kBins = 16;
/// From this depth on, the builder divides pieces into equal halves instead of by surface area. So the tree of any mesh
/// has at most kMostLevels: the number of pieces has 32 bits, so 32 more levels are enough.
constexpr int kLevelsBySurface = 24;

/// A triangle, or the part of it that lies in a box.
struct Piece {
  Box box;
  std::uint32_t triangle;
};

/// Half the surface of a box, which is proportional to the number of rays that hit it.
float half_area(const Box& box) {
  const Eigen::Vector3f d = box.sizes();
  return d.x() * d.y() + d.y() * d.z() + d.z() * d.x();
}

Box triangle_box(const TriangleMesh& mesh, std::uint32_t triangle) {
  Box box;
  for (const std::uint32_t vertex : mesh.triangles[triangle]) box.extend(mesh.vertices[vertex]);
  return box;
}

TriangleMesh turned(TriangleMesh mesh, const Eigen::Matrix3f& R_TW) {
  for (auto& vertex : mesh.vertices) vertex = R_TW * vertex;
  return mesh;
}

/// The turn about z, in steps of 5 degrees, with which the boxes around the triangles are smallest. Buildings have many
/// parallel walls and bars, and boxes along their directions contain less empty space.
Eigen::Matrix3f best_axes(const TriangleMesh& mesh) {
  Eigen::Matrix3f best = Eigen::Matrix3f::Identity();
  double least = std::numeric_limits<double>::infinity();
  for (int degrees = 0; degrees < 90; degrees += 5) {
    const Eigen::Matrix3f R_TW = rotation_z(degrees * kRadPerDeg).cast<float>();
    const TriangleMesh mesh_T = turned(mesh, R_TW);
    double area = 0.0;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      const float of_triangle = half_area(triangle_box(mesh_T, i));
      if (std::isfinite(of_triangle)) area += of_triangle;
    }
    if (area < least) {
      least = area;
      best = R_TW;
    }
  }
  return best;
}

/// The two parts of a piece on either side of a plane across an axis.
std::pair<Piece, Piece> cut(const Piece& piece, const TriangleMesh& mesh, int axis, float position) {
  Box below, above;
  const auto& corners = mesh.triangles[piece.triangle];
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3f &a = mesh.vertices[corners[k]], &b = mesh.vertices[corners[(k + 1) % 3]];
    if (a[axis] <= position) below.extend(a);
    if (a[axis] >= position) above.extend(a);
    if ((a[axis] < position) != (b[axis] < position) && a[axis] != b[axis]) {
      Eigen::Vector3f crossing = a + (position - a[axis]) / (b[axis] - a[axis]) * (b - a);
      crossing[axis] = position;
      below.extend(crossing);
      above.extend(crossing);
    }
  }
  return {{below.intersection(piece.box), piece.triangle}, {above.intersection(piece.box), piece.triangle}};
}

std::vector<Piece> pieces_of(const TriangleMesh& mesh) {
  std::vector<Piece> pieces;
  std::vector<float> flat;  // lower bound of half the surface of a box around the piece
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    const Eigen::Vector3f &p = mesh.vertices[a], &q = mesh.vertices[b], &r = mesh.vertices[c];
    const Eigen::Vector3f normal = (q - p).cross(r - p);
    if (!(normal.squaredNorm() > 0.0F && normal.squaredNorm() < std::numeric_limits<float>::infinity())) continue;
    pieces.push_back({triangle_box(mesh, i), i});
    flat.push_back(0.5F * normal.cwiseAbs().sum());
  }
  // Always cut the piece whose box exceeds this bound most ("air").
  std::priority_queue<std::pair<float, std::size_t>> air;
  for (std::size_t i = 0; i < pieces.size(); ++i) air.push({half_area(pieces[i].box) - flat[i], i});
  const auto most = static_cast<std::size_t>((1.0 + kExtraPieces) * static_cast<double>(pieces.size()));
  while (pieces.size() < most && !air.empty() && air.top().first > 0.0F) {
    const std::size_t i = air.top().second;
    air.pop();
    int axis = 0;
    pieces[i].box.sizes().maxCoeff(&axis);
    const auto [below, above] = cut(pieces[i], mesh, axis, pieces[i].box.center()[axis]);
    if (below.box.isEmpty() || above.box.isEmpty()) continue;  // too small to be cut in single precision
    pieces[i] = below;
    pieces.push_back(above);
    flat[i] *= 0.5F;
    flat.push_back(flat[i]);
    air.push({half_area(below.box) - flat[i], i});
    air.push({half_area(above.box) - flat[i], pieces.size() - 1});
  }
  return pieces;
}

Box box_of(std::span<const Piece> pieces) {
  Box box;
  for (const Piece& piece : pieces) box.extend(piece.box);
  return box;
}

/// Divides the range of centres into kBins equal slices; of() returns the slice of a piece.
struct Slices {
  int axis = 0;
  float start = 0.0F, scale = 0.0F;
  int of(const Piece& piece) const {
    const float slice = (piece.box.center()[axis] - start) * scale;
    return slice > 0.0F ? static_cast<int>(std::min(slice, kBins - 1.0F)) : 0;
  }
};

/// Partitions the pieces into two parts by the surface area heuristic; into halves of the list if all centres coincide.
/// @returns the size of the first part.
std::size_t divide(std::span<Piece> pieces) {
  Box centres;
  for (const Piece& piece : pieces) centres.extend(piece.box.center());
  float least = std::numeric_limits<float>::infinity();
  Slices best;
  int best_slice = -1;
  for (int axis = 0; axis < 3; ++axis) {
    const float length = centres.sizes()[axis];
    if (!(length > 1e-30F)) continue;  // nothing to divide along this axis, and 1 / length would be infinite
    const Slices slices{axis, centres.min()[axis], kBins / length};
    std::array<Box, kBins> boxes;
    std::array<int, kBins> counts{};
    for (const Piece& piece : pieces) {
      const int slice = slices.of(piece);
      boxes[slice].extend(piece.box);
      ++counts[slice];
    }
    std::array<float, kBins> cost_above{};
    Box box;
    int count = 0;
    for (int slice = kBins - 1; slice > 0; --slice) {
      box.extend(boxes[slice]);
      count += counts[slice];
      cost_above[slice] = count > 0 ? half_area(box) * static_cast<float>(count) : 0.0F;
    }
    box.setEmpty();
    count = 0;
    for (int slice = 0; slice + 1 < kBins; ++slice) {
      box.extend(boxes[slice]);
      count += counts[slice];
      const float cost = half_area(box) * static_cast<float>(count) + cost_above[slice + 1];
      if (cost < least) {
        least = cost;
        best = slices;
        best_slice = slice;
      }
    }
  }
  if (best_slice < 0) return pieces.size() / 2;
  const auto middle =
      std::stable_partition(pieces.begin(), pieces.end(), [&](const Piece& p) { return best.of(p) <= best_slice; });
  return static_cast<std::size_t>(middle - pieces.begin());
}

class Builder {
 public:
  Builder(const TriangleMesh& mesh_W, Tree& tree) : mesh_W_(mesh_W), tree_(tree) {}

  void add_root(std::span<Piece> pieces) { add_branch(pieces, 0); }

 private:
  std::int32_t add_leaf(std::span<const Piece> pieces) {
    Leaf leaf{};
    for (std::size_t lane = 0; lane < pieces.size(); ++lane) {
      leaf.triangles[lane] = pieces[lane].triangle;
      for (int corner = 0; corner < 3; ++corner) {
        const Eigen::Vector3f& vertex = mesh_W_.vertices[mesh_W_.triangles[pieces[lane].triangle][corner]];
        for (int axis = 0; axis < 3; ++axis) leaf.corners_W[corner][axis][lane] = vertex[axis];
      }
    }
    tree_.leaves.push_back(leaf);
    return ~static_cast<std::int32_t>(tree_.leaves.size() - 1);
  }

  /// Repeatedly divides the largest child, until there are eight children or each fits into a leaf.
  std::int32_t add_branch(std::span<Piece> pieces, int level) {
    constexpr float kNoBox = -1e18F;
    const auto index = static_cast<std::int32_t>(tree_.branches.size());
    tree_.branches.emplace_back();
    struct Child {
      std::span<Piece> pieces;
      Box box;
    };
    std::vector<Child> children = {{pieces, box_of(pieces)}};
    while (children.size() < kLanes) {
      const auto weight = [](const Child& c) { return c.pieces.size() > kLanes ? half_area(c.box) : -1.0F; };
      const auto largest = std::ranges::max_element(children, {}, weight);
      if (weight(*largest) < 0.0F) break;
      const std::size_t count = level < kLevelsBySurface ? divide(largest->pieces) : largest->pieces.size() / 2;
      const auto first = largest->pieces.first(count), rest = largest->pieces.subspan(count);
      *largest = {first, box_of(first)};
      children.push_back({rest, box_of(rest)});
    }
    Branch branch{};
    for (auto& axis : branch.half_T) std::ranges::fill(axis, kNoBox);
    for (std::size_t lane = 0; lane < children.size(); ++lane) {
      const auto& [part, box] = children[lane];
      branch.children[lane] = part.size() > kLanes ? add_branch(part, level + 1) : add_leaf(part);
      for (int axis = 0; axis < 3; ++axis) {
        branch.centre_T[axis][lane] = box.center()[axis];
        branch.half_T[axis][lane] = 0.5F * box.sizes()[axis];
      }
    }
    tree_.branches[static_cast<std::size_t>(index)] = branch;
    return index;
  }

  const TriangleMesh& mesh_W_;
  Tree& tree_;
};

}  // namespace

Tree build_tree(const TriangleMesh& mesh) {
  Tree tree;
  tree.R_TW = best_axes(mesh);
  std::vector<Piece> pieces = pieces_of(turned(mesh, tree.R_TW));
  if (pieces.empty()) return tree;
  for (const Piece& piece : pieces) {
    for (const std::uint32_t vertex : mesh.triangles[piece.triangle]) {
      tree.largest_coordinate = std::max(tree.largest_coordinate, mesh.vertices[vertex].cwiseAbs().maxCoeff());
    }
  }
  Builder(mesh, tree).add_root(pieces);
  return tree;
}

}  // namespace skein::sim::fan
