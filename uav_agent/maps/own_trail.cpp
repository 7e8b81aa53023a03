#include "uav_agent/maps/own_trail.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "uav_agent/maps/uav_traces.hpp"

namespace skein::agent {
namespace {

constexpr double kMostM = 1e5;  ///< farther from the origin, update() ignores a position as wrong; numeric
constexpr int kBlockBits = 2;   ///< memory: a block has 2^kBlockBits cubes along each axis

/// The bit that stands for a cube in the word of its block.
std::uint64_t bit_of(const Eigen::Vector3i& cube) {
  constexpr int kMask = (1 << kBlockBits) - 1;
  const int place = (cube.x() & kMask) | (cube.y() & kMask) << kBlockBits | (cube.z() & kMask) << 2 * kBlockBits;
  return std::uint64_t{1} << place;
}

}  // namespace

OwnTrail::OwnTrail(const AgentConfig& agent, double cell_m)
    : radius_m_(seen_radius_m(agent.me().body_radius_m, cell_m, kMarginM)), cell_m_(cell_m) {
  for (std::size_t uav = 0; uav < agent.fleet.size(); ++uav) {
    if (uav != agent.self && agent.fleet[uav].role == Role::explorer) lidars_.push_back(uav);
  }
}

bool OwnTrail::near(const Eigen::Vector3i& cube) const {
  return ((cube.cast<double>() + Vector3d::Constant(0.5)) * cell_m_ - p_WB_).norm() <= radius_m_;
}

void OwnTrail::mark() {
  const Eigen::Vector3i low = ((p_WB_.array() - radius_m_) / cell_m_).floor().cast<int>();
  const Eigen::Vector3i high = ((p_WB_.array() + radius_m_) / cell_m_).floor().cast<int>();
  for (int z = low.z(); z <= high.z(); ++z) {
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int x = low.x(); x <= high.x(); ++x) {
        const Eigen::Vector3i cube(x, y, z);
        if (near(cube)) newer_[grid_key(shifted(cube, kBlockBits))] |= bit_of(cube);
      }
    }
  }
}

void OwnTrail::update(Tick now, const Peers& peers, const Vector3d& p_WB) {
  p_WB_ = p_WB;
  if (now - newer_since_ >= ticks(kPartS)) {
    older_ = std::exchange(newer_, Part());
    newer_since_ = now;
  }
  const auto heard = [&](std::size_t uav) {
    const Peer* const peer = peers.find(uav);
    return peer != nullptr && peer->visible;
  };
  // maxCoeff() may ignore a coordinate that is not a number.
  const bool sound = p_WB.allFinite() && p_WB.cwiseAbs().maxCoeff() <= kMostM;
  if (sound && !std::ranges::all_of(lidars_, heard)) mark();
}

bool OwnTrail::contains(const Eigen::Vector3i& cube) const {
  if (near(cube)) return true;
  const std::uint64_t key = grid_key(shifted(cube, kBlockBits)), bit = bit_of(cube);
  return std::ranges::any_of(std::array{&newer_, &older_}, [&](const Part* part) {
    const std::uint64_t* const bits = part->find(key);
    return bits != nullptr && (*bits & bit) != 0;
  });
}

}  // namespace skein::agent
