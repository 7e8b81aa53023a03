// The interest points that the fleet has found, each with the best quality of its pictures, as far as this UAV knows;
// and their exchange by radio. A detection gives a point's place and normal.
//
// The exchange needs no acknowledgements: each UAV sends a hash for each region of the site, and the others send the
// regions in which theirs differ. Lists merge by the greater quality, in any order and any number of times. So a lost
// region is sent again, and a UAV whose program was restarted gets everything back.
// Frame W.   Units: SI.   Threads: one.   Deterministic.   Bounded: kMostRegions regions, `room` bytes per message.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "uav_agent/api/payload.hpp"
#include "uav_agent/api/peers.hpp"

namespace skein::agent {

struct FlockPoint {
  Vector3d p_W = Vector3d::Zero();
  Vector3d n_W = Vector3d::UnitX();  ///< unit normal, towards the side from which it was seen
  double q = 0.0;                    ///< best known quality
  int vain = 0;                      ///< own pictures in a row that should have improved q and did not
  Tick not_before = 0;               ///< the point is left out until then
};

class FlockPoints {
 public:
  static constexpr std::size_t kMostRegions = 800;

  /// Adds detections of this UAV's own camera.
  /// @param p_WC  position of the camera.
  void detect(std::span<const DetectedPoint> detected, const Vector3d& p_WC);
  /// Call it when a picture of this UAV should show a point better than any before. After ten pictures that did not,
  /// something must hide the point that is not on the map: the point is left out for two minutes.
  void expect_better(std::size_t point, Tick now);
  const std::vector<FlockPoint>& all() const { return points_; }

  /// Appends the hashes of all regions, and regions that differ at a UAV in line of sight.
  /// @param room  most bytes of regions' points.
  void write(const Peers& peers, Tick now, std::size_t room, PayloadWriter& writer) const;
  /// Reads a message of another UAV's write().
  /// @returns false if the message is damaged; the parts before the damage have taken effect.
  bool read(std::size_t sender, Tick now, PayloadReader& reader);

 private:
  using Cell = std::array<std::int16_t, 3>;    ///< index of a region along the axes
  using Place = std::array<std::uint16_t, 3>;  ///< position within its region [cm]
  using Hashes = std::map<Cell, std::uint16_t>;

  struct Region {
    std::map<Place, std::size_t> points;  ///< indices into points_
    mutable std::uint16_t hash = 0;
    mutable bool changed = true;  ///< since the hash was computed
  };
  struct Account {
    Hashes hashes;
    Tick heard = 0;
  };

  void take(const Vector3d& p_W, const Vector3d& n_W, double q, const Vector3d* p_WC);
  std::uint16_t hash_of(const Region& region) const;
  void write_slice(const Cell& cell, const Region& region, std::size_t most, PayloadWriter& writer) const;
  void write_region(const Cell& cell, const Region& region, std::size_t first, std::size_t count,
                    PayloadWriter& writer) const;
  bool read_region(PayloadReader& reader);

  std::vector<FlockPoint> points_;
  std::map<Cell, Region> regions_;
  std::map<std::size_t, Account> accounts_;  ///< by sender: the hashes that it has sent
  mutable std::size_t next_ = 0;             ///< regions to send take turns
  mutable std::size_t slice_ = 0;            ///< first point of the next slice of a region; 0: no slice is due
};

}  // namespace skein::agent
