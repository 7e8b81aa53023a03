// The interest points that the fleet has found, each with the best quality of its pictures, as far as this UAV knows;
// and their exchange by radio. A detection gives a point's place and normal.
//
// The exchange needs no acknowledgements: each UAV sends a hash for each region of the site, and the others send the
// regions in which theirs differ. Lists merge by the greater quality, in any order and any number of times. So a lost
// region is sent again, and a UAV whose program was restarted gets everything back.
//
// With odometry errors, each UAV sees a point at another place, which drifts. A UAV identifies its own points by their
// order. A point of another UAV that is nearer than `merge_m` to one of its own counts as the same, and the lesser of
// the two places (by region, then by position) stays: so all UAVs end up with the same list.
// Frame W.   Units: SI.   Threads: one.   Deterministic.   Bounded: kMostRegions regions, `room` bytes per message.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <tuple>
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
  static constexpr std::size_t kMostRegions = 800;  ///< chosen: leaves room in a message beside their hashes
  /// A point or a surface that pictures do not show although they should is left out for this time. Chosen.
  static constexpr double kLeftOutS = 120.0;

  /// @param merge_m  distance within which detections may be of the same point; 0: places are exact.
  explicit FlockPoints(double merge_m = 0.0) : merge_m_(merge_m) {}

  /// Adds detections of this UAV's own camera.
  /// @param p_WC  position of the camera.
  /// @returns by how much they raise the sum of the best known qualities.
  double detect(std::span<const DetectedPoint> detected, const Vector3d& p_WC);
  /// Call it when a picture of this UAV should show a point better than any before. After ten pictures that did not,
  /// something must hide the point that is not on the map: the point is left out for two minutes.
  void expect_better(std::size_t point, Tick now);
  /// Forgets the pictures that did not show a point, and leaves none out: the camera had failed.
  void expect_again();
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
    mutable Place next_slice = {};        ///< where its next slice begins
    mutable std::uint16_t hash = 0;
    mutable bool changed = true;  ///< since the hash was computed
  };
  struct Account {
    Hashes hashes;
    Tick heard = 0;
  };

  struct Spot {
    Cell cell;
    Place place;
    bool operator<(const Spot& other) const { return std::tie(cell, place) < std::tie(other.cell, other.place); }
  };
  struct Told {
    Vector3d p_W = Vector3d::Zero(), n_W = Vector3d::Zero();
    double q = 0.0;
    std::optional<std::uint32_t> own = {};  ///< order of a point of this UAV's own camera; nullopt: another UAV's
  };

  static std::optional<Spot> spot_of(const Told& told);
  /// Adds points of one UAV, which are different ones: in exact places, or nearest to known ones, or new.
  /// @returns the same as detect().
  double take(const std::vector<Told>& all, const Vector3d* p_WC);
  double raise(std::size_t point, const Told& told, const Spot& spot);
  std::optional<std::size_t> add(const Told& told, const Spot& spot, const Vector3d* p_WC);
  /// Index of the point with this order, or in exactly this place.
  std::optional<std::size_t> known(const Told& told, const Spot& spot) const;
  std::optional<std::size_t> nearest(const Told& told, const std::set<std::size_t>& except) const;
  void move(std::size_t point, const Spot& to, const Vector3d& p_W);
  std::uint16_t hash_of(const Region& region) const;
  void write_slice(const Cell& cell, const Region& region, std::size_t most, PayloadWriter& writer) const;
  void write_region(const Cell& cell, std::map<Place, std::size_t>::const_iterator first, std::size_t count,
                    PayloadWriter& writer) const;
  bool read_region(PayloadReader& reader);

  double merge_m_;
  std::vector<FlockPoint> points_;
  std::vector<Spot> spots_;                   ///< of points_
  std::vector<bool> is_own_;                  ///< by point: this UAV's camera has detected it
  std::map<std::uint32_t, std::size_t> own_;  ///< by order: this UAV's own points; only if places are not exact
  std::map<Cell, Region> regions_;
  std::map<std::size_t, Account> accounts_;  ///< by sender: the hashes that it has sent
  mutable std::size_t next_ = 0;             ///< regions to send take turns
  mutable std::optional<Cell> sliced_;       ///< the region of which the next slice is due; nullopt: none
};

}  // namespace skein::agent
