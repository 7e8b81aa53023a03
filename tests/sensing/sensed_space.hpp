// A LiDAR in empty space, and the map that its beams make; and members drawn into it afterwards: had one stood there,
// would a beam have met it? The map would be the same if none had.
// Frames: W world, B body, L LiDAR.   Units: metres, radians.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/random_stream.hpp"
#include "core/scenario.hpp"
#include "uav_agent/maps/world_mapper.hpp"

namespace skein::sensing {

inline constexpr double kBodyRadiusM = 0.63;                    ///< arm and rotor
inline constexpr double kTubeM = kBodyRadiusM + agent::kHaloM;  ///< where all must be free

inline constexpr double kHeightM = 60.0;  ///< of the flights, above the ground

/// How a UAV moves, by time.
struct Flight {
  std::string name;
  double duration_s = 8.0;
  std::function<Isometry3d(double)> X_WB;
};

/// Hovering still and in wind, turning, creeping, along a line, in a circle.
std::vector<Flight> flights();

/// A straight member without ends' caps.
struct Member {
  Vector3d p_W = Vector3d::Zero();  ///< its middle
  Vector3d direction_W = Vector3d::UnitX();
  double length_m = 2.0, width_m = 0.05;
};

/// All beams, each for itself, and cubes of half a metre everywhere: what flies is never to call more free.
agent::WorldMapper::Config exact_map();

class SensedSpace {
 public:
  /// @param lidar  flies. What it loses is drawn, by seed 1 at first, and is missing from what it saw.
  /// @param told   what the map takes it for: in its `no_return_p` and `dropped_sectors` it may differ.
  SensedSpace(const Flight& flight, double servo_phase_s, const agent::WorldMapper::Config& config,
              const LidarConfig& lidar = {}, const LidarConfig& told = {});

  /// Draws by another seed what it loses. The map stays what it is: a LiDAR in empty space returns nothing anyway.
  void lose(std::uint64_t seed);

  const agent::WorldMap& map() const { return mapper_.map(); }
  agent::WorldMap& map() { return mapper_.map(); }
  /// Where the LiDAR was at all of its scans.
  const std::vector<Isometry3d>& scans() const { return scans_; }
  double distance_to_route_m(const Vector3d& p_W) const;
  /// Whether a beam met the part of the member that lies within `reach_m` of the segment.
  bool saw(const Member& member, const Vector3d& a_W, const Vector3d& b_W, double reach_m) const;

 private:
  LidarConfig lidar_;
  std::vector<Isometry3d> scans_, inverse_;
  std::vector<Vector3d> beams_L_;        ///< ring by ring
  std::vector<std::vector<bool>> lost_;  ///< of each scan: its beams without return, whatever they meet
  agent::WorldMapper mapper_;

  bool meets(std::size_t scan, const Vector3d& from_W, const Vector3d& to_W, double width_m) const;
};

Vector3d drawn_direction(RandomStream& random);
/// Evenly of all that touch the body's tube about the segment.
Member drawn_member(RandomStream& random, const Vector3d& a_W, const Vector3d& b_W);

}  // namespace skein::sensing
