// The interest points that the fleet has found, with the best quality that any of its UAVs is known to have
// photographed each with; and their exchange by radio. A point's place and normal come with the picture that shows it.
//
// The exchange needs no acknowledgement: each UAV tells a hash for each region of the site, and the others send the
// regions in which they differ. Two lists merge by the greater quality, in any order, as often as wanted; so what was
// lost on the way goes out again, and a UAV whose program was restarted gets everything back.
// Frame W.   Units: SI.   Threads: one.   Deterministic.   Bounded: kMostRegions regions, and a message's room.
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
  Vector3d n_W = Vector3d::UnitX();  ///< unit normal, to the side from which it was seen
  double q = 0.0;                    ///< best quality that is known of
  int vain = 0;                      ///< own pictures in a row that should have been better, and were not
  Tick not_before = 0;               ///< it is left alone so long
};

class FlockPoints {
 public:
  static constexpr std::size_t kMostRegions = 800;

  /// What was in this UAV's own pictures.
  /// @param p_WC  where its camera was.
  void detect(std::span<const DetectedPoint> detected, const Vector3d& p_WC);
  /// A picture of this UAV should have shown a point better than any did before. Where many do not, what hides it is
  /// not on the map: it is left alone for a while.
  void expect_better(std::size_t point, Tick now);
  const std::vector<FlockPoint>& all() const { return points_; }

  /// Appends hashes of all regions, and those regions that a UAV in line of sight has otherwise.
  /// @param room  bytes for regions' points.
  void write(const Peers& peers, Tick now, std::size_t room, PayloadWriter& writer) const;
  /// Takes in what write() wrote elsewhere.
  /// @returns false when the message is damaged; what came before the damage was taken.
  bool read(std::size_t sender, Tick now, PayloadReader& reader);

 private:
  using Cell = std::array<std::int16_t, 3>;    ///< of a region
  using Place = std::array<std::uint16_t, 3>;  ///< within its region [cm]
  using Hashes = std::map<Cell, std::uint16_t>;

  struct Region {
    std::map<Place, std::size_t> points;  ///< indices into points_
    mutable std::uint16_t hash = 0;
    mutable bool changed = true;  ///< since the hash was worked out
  };
  struct Account {
    Hashes hashes;
    Tick heard = 0;
  };

  void take(const Vector3d& p_W, const Vector3d& n_W, double q, const Vector3d* p_WC);
  std::uint16_t hash_of(const Region& region) const;
  std::uint16_t write_slice(const Cell& cell, const Region& region, std::size_t most, PayloadWriter& writer) const;
  void write_region(const Cell& cell, const Region& region, std::size_t first, std::size_t count,
                    PayloadWriter& writer) const;
  bool read_region(PayloadReader& reader);

  std::vector<FlockPoint> points_;
  std::map<Cell, Region> regions_;
  std::map<std::size_t, Account> accounts_;  ///< by sender: what it said that it has
  mutable std::size_t next_ = 0;             ///< regions take turns
  mutable std::size_t slice_ = 0;            ///< first point of the next slice of a region; 0: no slice is due
};

}  // namespace skein::agent
