#include "uav_agent/maps/known_space.hpp"

#include <octomap/OcTree.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <sstream>
#include <utility>

namespace skein::agent {
namespace {

constexpr float kRayLogOdds =
    -0.125F;  ///< added to a cell's log-odds for each ray that passed it; numeric: sums are exact
constexpr int kKeyOfOrigin = 1 << 15;  ///< OctoMap's format: key of the cell whose lowest corner is the origin
constexpr unsigned kChildren = 8;      ///< geometry: of an inner node of an octree
constexpr unsigned kBlockLevels = 2;   ///< memory: from a block of 4 x 4 x 4 cells down to a cell

octomap::point3d octomap_point(const Vector3d& p_W) {
  return {static_cast<float>(p_W.x()), static_cast<float>(p_W.y()), static_cast<float>(p_W.z())};
}

int rays_of(const octomap::OcTreeNode& free_cell) {
  return static_cast<int>(std::lround(free_cell.getLogOdds() / kRayLogOdds));
}

/// Descends from a node at depth `from` towards a cell, and creates missing nodes. @returns the node at depth `to`.
octomap::OcTreeNode* grown(octomap::OcTree& tree, octomap::OcTreeNode* node, const octomap::OcTreeKey& key,
                           unsigned from, unsigned to) {
  for (unsigned depth = from; depth < to; ++depth) {
    const unsigned child = octomap::computeChildIdx(key, static_cast<int>(tree.getTreeDepth() - 1 - depth));
    node = tree.nodeChildExists(node, child) ? tree.getNodeChild(node, child) : tree.createNodeChild(node, child);
  }
  return node;
}

/// The node of the block that contains a cell. Callers reuse it for the block's other cells, since the descent is long.
octomap::OcTreeNode* block_node(octomap::OcTree& tree, const octomap::OcTreeKey& key) {
  if (tree.getRoot() == nullptr) tree.setNodeValue(key, 0.0F, true);
  return grown(tree, tree.getRoot(), key, 0, tree.getTreeDepth() - kBlockLevels);
}

octomap::OcTreeNode* cell_node(octomap::OcTree& tree, octomap::OcTreeNode* block, const octomap::OcTreeKey& key) {
  return grown(tree, block, key, tree.getTreeDepth() - kBlockLevels, tree.getTreeDepth());
}

/// Calls `use` with the centre of each cell of this size in a cube; if the cube is smaller, with the cube's centre.
void each_cell(const KnownCube& cube, double cell_m, const auto& use) {
  const long count = std::max(1L, std::lround(cube.edge_m / cell_m));
  const double edge_m = cube.edge_m / static_cast<double>(count);
  for (long x = 0; x < count; ++x) {
    for (long y = 0; y < count; ++y) {
      for (long z = 0; z < count; ++z) use(cube.lowest_W + edge_m * (Vector3d(x, y, z) + Vector3d::Constant(0.5)));
    }
  }
}

Eigen::Vector3i cell_of(const octomap::OcTreeKey& key) {
  return Eigen::Vector3i(key[0], key[1], key[2]).array() - kKeyOfOrigin;
}

octomap::OcTreeKey key_of(const Eigen::Vector3i& cell) {
  const auto along = [&](int axis) { return static_cast<octomap::key_type>(cell[axis] + kKeyOfOrigin); };
  return {along(0), along(1), along(2)};
}

/// Visits cells in the order of OctoMap's leaf_bbx_iterator, but faster.
template <class Visit>
class LeavesInBox {
 public:
  /// @param lowest, highest  cells at two corners of the box, inclusive.
  LeavesInBox(const octomap::OcTree& tree, const octomap::OcTreeKey& lowest, const octomap::OcTreeKey& highest,
              const Visit& visit)
      : tree_(tree), lowest_(lowest), highest_(highest), visit_(visit) {}

  /// Visits the cells below a node. @param first  the node's lowest cell on each axis.
  void below(const octomap::OcTreeNode* node, const octomap::OcTreeKey& first, unsigned depth) const {
    if (depth == tree_.getTreeDepth()) return visit_(first);
    const unsigned half = 1U << (tree_.getTreeDepth() - depth - 1);
    for (unsigned i = 0; i < kChildren; ++i) {
      if (!tree_.nodeChildExists(node, i)) continue;
      octomap::OcTreeKey key = first;
      bool inside = true;
      for (unsigned axis = 0; axis < 3; ++axis) {
        key[axis] = static_cast<octomap::key_type>(key[axis] + (i >> axis & 1U) * half);
        inside = inside && key[axis] <= highest_[axis] && key[axis] + half > lowest_[axis];
      }
      if (inside) below(tree_.getNodeChild(node, i), key, depth + 1);
    }
  }

 private:
  const octomap::OcTree& tree_;
  const octomap::OcTreeKey lowest_, highest_;
  const Visit& visit_;
};

/// Merges hits and free space into one pruned tree, in OctoMap's binary serialisation: each inner node has two bytes,
/// two bits for each child; the nodes of its children follow.
class JoinedTree {
 public:
  /// @param rays  number of rays that must have passed a coarse cell for it to be free.
  JoinedTree(const octomap::OcTree& hits, const octomap::OcTree& free, int rays)
      : hits_(hits),
        free_(free),
        rays_(rays),
        levels_(static_cast<unsigned>(std::lround(std::log2(free.getResolution() / hits.getResolution())))) {
    const auto octant = [this](unsigned i) { return write(child(hits_, hits_.getRoot(), i), free_octant(i), false); };
    if (inner(octant) != kNothing) ++nodes_;
  }

  const std::string& bytes() const { return bytes_; }
  std::size_t nodes() const { return nodes_; }

 private:
  using Node = octomap::OcTreeNode;
  enum Kind : unsigned { kNothing = 0, kFree = 1, kOccupied = 2, kInner = 3 };

  static const Node* child(const octomap::OcTree& tree, const Node* node, unsigned i) {
    return node != nullptr && tree.nodeChildExists(node, i) ? tree.getNodeChild(node, i) : nullptr;
  }

  /// The node of `free_` with the same cube as octant i of `hits_`. Both trees are centred at the origin and have the
  /// same depth, but free cells are larger, so `free_` extends farther.
  const Node* free_octant(unsigned i) const {
    const Node* node = child(free_, free_.getRoot(), i);
    for (unsigned level = 0; level < levels_; ++level) node = child(free_, node, kChildren - 1 - i);
    return node;
  }

  /// @param hit, free  nodes of the same cube; null: none.   @param in_free  whether a larger cube around it is free.
  Kind write(const Node* hit, const Node* free, bool in_free) {
    if (hit != nullptr && !hits_.nodeHasChildren(hit)) return kOccupied;
    if (free != nullptr && !free_.nodeHasChildren(free)) {
      in_free = rays_of(*free) >= rays_;
      free = nullptr;
    }
    if (hit == nullptr && free == nullptr) return in_free ? kFree : kNothing;
    return inner([&](unsigned i) { return write(child(hits_, hit, i), child(free_, free, i), in_free); });
  }

  /// Writes an inner node, unless all its children are leaves of the same kind.
  /// @param kind_of  writes the i-th child and returns its kind.
  Kind inner(const auto& kind_of) {
    const std::size_t begin = bytes_.size();
    bytes_.append(2, 0);
    std::array<Kind, kChildren> kinds;
    for (unsigned i = 0; i < kChildren; ++i) kinds[i] = kind_of(i);
    if (kinds[0] != kInner && std::ranges::all_of(kinds, [&](Kind kind) { return kind == kinds[0]; })) {
      bytes_.resize(begin);
      return kinds[0];
    }
    for (unsigned i = 0; i < kChildren; ++i) {
      bytes_[begin + i / 4] = static_cast<char>(bytes_[begin + i / 4] | kinds[i] << (2 * (i % 4)));
      nodes_ += kinds[i] == kNothing ? 0 : 1;
    }
    return kInner;
  }

  const octomap::OcTree& hits_;
  const octomap::OcTree& free_;
  const int rays_;
  const unsigned levels_;  ///< number of tree levels between a free cell and a hit cell
  std::string bytes_;
  std::size_t nodes_ = 0;
};

}  // namespace

/// The trees are never pruned: each known cell is a leaf at the finest depth. Values of inner nodes are not updated.
struct KnownSpace::Trees {
  Trees(double cell_m, double free_cell_m) : hits(cell_m), free(free_cell_m) {
    free.setClampingThresMin(octomap::probability(kCountedRays * kRayLogOdds));
  }

  octomap::OcTree hits, free;
};

KnownSpace::KnownSpace(double cell_m, double free_cell_m)
    : trees_(std::make_unique<Trees>(cell_m, free_cell_m)), hits_(cell_m) {}
KnownSpace::~KnownSpace() = default;

HitCells KnownSpace::cells_of_hits(const std::vector<Eigen::Vector3f>& hits_W, double ground_m) const {
  HitCells hits;
  BlockTable<std::size_t> places;  // by block: index in hits.blocks, plus 1; 0: none
  for (const Eigen::Vector3f& hit_W : hits_W) {
    octomap::OcTreeKey key;
    if (hit_W.cast<double>().z() < ground_m) continue;
    if (!trees_->hits.coordToKeyChecked(octomap::point3d(hit_W.x(), hit_W.y(), hit_W.z()), key)) continue;
    std::size_t& place = places[RayBlocks::block_of({key[0], key[1], key[2]})];
    const Eigen::Vector3i cell = cell_of(key);
    if (place == 0) {
      hits.blocks.push_back({HitBlocks::block_of(cell)});
      place = hits.blocks.size();
    }
    hits.blocks[place - 1].cells |= std::uint64_t{1} << HitBlocks::place_of(cell);
  }
  return hits;
}

bool KnownSpace::add_hits(const HitCells& hits) {
  octomap::OcTree& tree = trees_->hits;
  bool any = false;
  for (const HitCells::Block& block : hits.blocks) {
    std::uint64_t news = hits_.add(block.at, block.cells);
    if (news == 0) continue;
    any = true;
    octomap::OcTreeNode* its_node = nullptr;
    for (; news != 0; news &= news - 1) {
      const int bit = std::countr_zero(news);
      const octomap::OcTreeKey key = key_of(HitBlocks::cell_at(block.at, bit));
      if (its_node == nullptr) its_node = block_node(tree, key);
      cell_node(tree, its_node, key)->setLogOdds(tree.getClampingThresMaxLog());
    }
  }
  return any;
}

bool KnownSpace::add_hit(const Vector3d& p_W) {
  octomap::OcTreeKey key;
  if (!trees_->hits.coordToKeyChecked(octomap_point(p_W), key)) return false;
  const Eigen::Vector3i cell = cell_of(key);
  return add_hits({{{HitBlocks::block_of(cell), std::uint64_t{1} << HitBlocks::place_of(cell)}}});
}

PassedCells KnownSpace::passed_by_rays(const Vector3d& from_W, const std::vector<Vector3d>& to_W) const {
  thread_local octomap::KeyRay ray;  // large, so kept; per thread, for agents in one process
  PassedCells passed;
  BlockTable<std::size_t> places;  // by block: index in passed.blocks, plus 1; 0: none
  for (const Vector3d& to : to_W) {
    if (!trees_->free.computeRayKeys(octomap_point(from_W), octomap_point(to), ray)) continue;
    PassedCells::Block* block = nullptr;
    std::uint64_t its_key = 0;
    for (const octomap::OcTreeKey& key : ray) {
      const RayBlocks::Cell cell = {key[0], key[1], key[2]};
      if (block == nullptr || RayBlocks::block_of(cell) != its_key) {
        its_key = RayBlocks::block_of(cell);
        std::size_t& place = places[its_key];
        if (place == 0) {
          passed.blocks.push_back({its_key, {}});
          place = passed.blocks.size();
        }
        block = &passed.blocks[place - 1].second;
      }
      std::uint8_t& count = (*block)[RayBlocks::place_of(cell)];
      count = RayBlocks::counted(count + 1);
    }
  }
  return passed;
}

void KnownSpace::add_rays(const PassedCells& passed) {
  octomap::OcTree& tree = trees_->free;
  octomap::OcTreeNode* its_node = nullptr;
  std::uint64_t its_key = 0;
  rays_.add(passed, [&](const RayBlocks::Cell& cell, int rays) {
    const octomap::OcTreeKey key(cell[0], cell[1], cell[2]);
    if (const std::uint64_t block = RayBlocks::block_of(cell); its_node == nullptr || block != its_key) {
      its_node = block_node(tree, key);
      its_key = block;
    }
    tree.updateNodeLogOdds(cell_node(tree, its_node, key), static_cast<float>(rays) * kRayLogOdds);
  });
}

bool KnownSpace::hear(const std::vector<KnownCube>& cubes, int rays) {
  bool news = false;
  for (const KnownCube& cube : cubes) {
    if (cube.occupied) {
      each_cell(cube, trees_->hits.getResolution(), [&](const Vector3d& middle_W) { news |= add_hit(middle_W); });
    } else {
      each_cell(cube, trees_->free.getResolution(), [&](const Vector3d& middle_W) { raise_rays(middle_W, rays); });
    }
  }
  return news;
}

void KnownSpace::raise_rays(const Vector3d& p_W, int rays) {
  octomap::OcTreeKey key;
  if (!trees_->free.coordToKeyChecked(octomap_point(p_W), key)) return;
  const RayBlocks::Cell cell = {key[0], key[1], key[2]};
  const int more = rays - rays_.at(cell);
  if (more <= 0) return;
  PassedCells passed{{{RayBlocks::block_of(cell), {}}}};
  passed.blocks.front().second[RayBlocks::place_of(cell)] = RayBlocks::counted(more);
  add_rays(passed);
}

int KnownSpace::rays_at(const Vector3d& p_W) const {
  octomap::OcTreeKey key;
  if (!trees_->free.coordToKeyChecked(octomap_point(p_W), key)) return 0;
  const RayBlocks::Cell cell = {key[0], key[1], key[2]};
  return rays_.at(cell);
}

void KnownSpace::visit_hits(const Vector3d& lowest_W, const Vector3d& highest_W,
                            const std::function<void(const Vector3d&)>& visit) const {
  const octomap::OcTree& tree = trees_->hits;
  octomap::OcTreeKey lowest, highest;
  if (tree.getRoot() == nullptr || !tree.coordToKeyChecked(octomap_point(lowest_W), lowest) ||
      !tree.coordToKeyChecked(octomap_point(highest_W), highest)) {
    return;
  }
  LeavesInBox(tree, lowest, highest, [&](const octomap::OcTreeKey& key) {
    visit({tree.keyToCoord(key[0]), tree.keyToCoord(key[1]), tree.keyToCoord(key[2])});
  }).below(tree.getRoot(), {0, 0, 0}, 0);
}

void KnownSpace::visit_free(const std::function<void(const RayBlocks::Cell&, int)>& visit) const {
  const auto end = trees_->free.end_leafs();
  for (auto leaf = trees_->free.begin_leafs(); leaf != end; ++leaf) {
    const octomap::OcTreeKey key = leaf.getKey();
    visit({key[0], key[1], key[2]}, rays_of(*leaf));
  }
}

std::string KnownSpace::octomap_bytes(int rays) const { return JoinedTree(trees_->hits, trees_->free, rays).bytes(); }

std::string KnownSpace::octomap_file(int rays) const {
  const JoinedTree joined(trees_->hits, trees_->free, rays);
  std::ostringstream out;
  out << "# Octomap OcTree binary file\n# (feel free to add / change comments, but leave the first line as it is!)\n"
      << "#\nid OcTree\nsize " << joined.nodes() << "\nres " << trees_->hits.getResolution() << "\ndata\n"
      << joined.bytes();
  return std::move(out).str();
}

}  // namespace skein::agent
