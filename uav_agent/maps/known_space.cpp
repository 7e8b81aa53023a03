#include "uav_agent/maps/known_space.hpp"

#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace skein::agent {
namespace {

constexpr float kRayLogOdds = -0.125F;  ///< of a cell being occupied, for each ray that passed it; sums are exact
constexpr int kKeyOfOrigin = 1 << 15;   ///< OctoMap's number of the cell that begins at 0
constexpr std::size_t kChildren = 8;

octomap::point3d octomap_point(const Vector3d& p_W) {
  return {static_cast<float>(p_W.x()), static_cast<float>(p_W.y()), static_cast<float>(p_W.z())};
}

int rays_of(const octomap::OcTreeNode& free_cell) {
  return static_cast<int>(std::lround(free_cell.getLogOdds() / kRayLogOdds));
}

/// Whatever is not there below a node becomes free.
void fill_with_free(octomap::OcTree& tree, octomap::OcTreeNode* node, unsigned depth) {
  if (depth == tree.getTreeDepth()) return;
  for (unsigned i = 0; i < kChildren; ++i) {
    if (tree.nodeChildExists(node, i)) {
      fill_with_free(tree, tree.getNodeChild(node, i), depth + 1);
    } else {
      tree.createNodeChild(node, i)->setLogOdds(tree.getClampingThresMinLog());
    }
  }
}

/// Makes the cube of `depth` that holds the cell `key` free, but for what is occupied in it.
void set_free(octomap::OcTree& tree, const octomap::OcTreeKey& key, unsigned depth) {
  if (tree.getRoot() == nullptr) tree.setNodeValue(key, tree.getClampingThresMinLog(), true);
  octomap::OcTreeNode* node = tree.getRoot();
  bool is_new = false;
  for (unsigned above = 0; above < depth; ++above) {
    const unsigned child = octomap::computeChildIdx(key, static_cast<int>(tree.getTreeDepth() - 1 - above));
    is_new = !tree.nodeChildExists(node, child);
    node = is_new ? tree.createNodeChild(node, child) : tree.getNodeChild(node, child);
  }
  if (is_new) {
    node->setLogOdds(tree.getClampingThresMinLog());
  } else {
    fill_with_free(tree, node, depth);
  }
}

/// All below a node, in one walk: OctoMap's prune() takes one a level, and ends at the first that has nothing to prune.
void prune(octomap::OcTree& tree, octomap::OcTreeNode* node) {
  for (unsigned i = 0; i < kChildren; ++i) {
    if (!tree.nodeChildExists(node, i)) continue;
    octomap::OcTreeNode* const child = tree.getNodeChild(node, i);
    if (tree.nodeHasChildren(child)) prune(tree, child);
  }
  tree.pruneNode(node);
}

/// Calls `use` with the middle of each cell of this size in a cube; of a cube that is smaller, with its own.
template <class Use>
void each_cell(const KnownCube& cube, double cell_m, const Use& use) {
  const long count = std::max(1L, std::lround(cube.edge_m / cell_m));
  const double edge_m = cube.edge_m / static_cast<double>(count);
  for (long x = 0; x < count; ++x) {
    for (long y = 0; y < count; ++y) {
      for (long z = 0; z < count; ++z) use(cube.lowest_W + edge_m * (Vector3d(x, y, z) + Vector3d::Constant(0.5)));
    }
  }
}

}  // namespace

/// Never pruned: each known cell is a leaf of the finest depth. Values of inner nodes are not kept up.
struct KnownSpace::Trees {
  Trees(double cell_m, double free_cell_m) : hits(cell_m), free(free_cell_m) {
    free.setClampingThresMin(octomap::probability(kCountedRays * kRayLogOdds));
  }

  octomap::OcTree joined(int rays) const;

  octomap::OcTree hits, free;
  mutable octomap::KeyRay ray;  ///< for the moment: it is large
};

KnownSpace::KnownSpace(double cell_m, double free_cell_m)
    : trees_(std::make_unique<Trees>(cell_m, free_cell_m)), hits_(cell_m) {}
KnownSpace::~KnownSpace() = default;

bool KnownSpace::add_hit(const Vector3d& p_W) {
  octomap::OcTree& tree = trees_->hits;
  octomap::OcTreeKey key;
  if (!tree.coordToKeyChecked(octomap_point(p_W), key)) return false;
  if (!hits_.set({key[0] - kKeyOfOrigin, key[1] - kKeyOfOrigin, key[2] - kKeyOfOrigin})) return false;
  tree.updateNode(key, tree.getClampingThresMaxLog(), true);
  return true;
}

PassedCells KnownSpace::passed_by_rays(const Vector3d& from_W, const std::vector<Vector3d>& to_W) const {
  PassedCells passed;
  BlockTable<std::size_t> places;  // in `passed`, by block; from 1 on
  for (const Vector3d& to : to_W) {
    if (!trees_->free.computeRayKeys(octomap_point(from_W), octomap_point(to), trees_->ray)) continue;
    PassedCells::Block* block = nullptr;
    std::uint64_t its_key = 0;
    for (const octomap::OcTreeKey& key : trees_->ray) {
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

void KnownSpace::add_rays(const PassedCells& passed) { add(passed, rays_); }
void KnownSpace::add_looks(const PassedCells& passed) { add(passed, looks_); }

void KnownSpace::add(const PassedCells& passed, RayBlocks& counts) {
  counts.add(passed, [this](const RayBlocks::Cell& cell, int rays) {
    const octomap::OcTreeKey key(cell[0], cell[1], cell[2]);
    const float more = static_cast<float>(rays) * kRayLogOdds;
    if (octomap::OcTreeNode* const leaf = trees_->free.search(key)) {
      trees_->free.updateNodeLogOdds(leaf, more);
    } else {
      trees_->free.updateNode(key, more, true);
    }
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

int KnownSpace::rays_at(const Vector3d& p_W, Evidence evidence) const {
  octomap::OcTreeKey key;
  if (!trees_->free.coordToKeyChecked(octomap_point(p_W), key)) return 0;
  const RayBlocks::Cell cell = {key[0], key[1], key[2]};
  return evidence == Evidence::rays ? rays_.at(cell) : RayBlocks::counted(rays_.at(cell) + looks_.at(cell));
}

void KnownSpace::visit_hits(const Vector3d& lowest_W, const Vector3d& highest_W,
                            const std::function<void(const Vector3d&)>& visit) const {
  const octomap::OcTree& tree = trees_->hits;
  const auto end = tree.end_leafs_bbx();
  for (auto leaf = tree.begin_leafs_bbx(octomap_point(lowest_W), octomap_point(highest_W)); leaf != end; ++leaf) {
    visit({leaf.getX(), leaf.getY(), leaf.getZ()});
  }
}

void KnownSpace::visit_free(const std::function<void(const RayBlocks::Cell&, int)>& visit) const {
  const auto end = trees_->free.end_leafs();
  for (auto leaf = trees_->free.begin_leafs(); leaf != end; ++leaf) {
    const octomap::OcTreeKey key = leaf.getKey();
    visit({key[0], key[1], key[2]}, rays_of(*leaf));
  }
}

octomap::OcTree KnownSpace::Trees::joined(int rays) const {
  octomap::OcTree tree(hits);
  const auto finer = static_cast<unsigned>(std::lround(std::log2(free.getResolution() / tree.getResolution())));
  const auto end = free.end_leafs();
  for (auto leaf = free.begin_leafs(); leaf != end; ++leaf) {
    octomap::OcTreeKey key;  // of a small cell at the middle of the coarse one
    if (rays_of(*leaf) < rays || !tree.coordToKeyChecked(leaf.getCoordinate(), key)) continue;
    set_free(tree, key, tree.getTreeDepth() - finer);
  }
  if (tree.getRoot() != nullptr) prune(tree, tree.getRoot());
  return tree;
}

std::string KnownSpace::octomap_bytes(int rays) const {
  std::ostringstream out;
  trees_->joined(rays).writeBinaryData(out);
  return std::move(out).str();
}

std::string KnownSpace::octomap_file(int rays) const {
  std::ostringstream out;
  trees_->joined(rays).writeBinaryConst(out);
  return std::move(out).str();
}

}  // namespace skein::agent
