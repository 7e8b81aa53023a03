// Simulates a LiDAR in empty space and the map of its beams. Then structural members are drawn into that space: if one
// had stood there, would a beam have hit it? If no beam had, the map would be the same.
// Frames: W world, B body, L LiDAR.   Units: metres, radians.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/math/random_stream.hpp"
#include "core/scenario/scenario.hpp"
#include "uav_agent/maps/world_mapper.hpp"

namespace skein::sensing {

inline constexpr double kBodyRadiusM = 0.63;                    ///< arm and rotor
inline constexpr double kTubeM = kBodyRadiusM + agent::kHaloM;  ///< radius within which all space must be free

inline constexpr double kHeightM = 60.0;  ///< height of the flights above the ground

/// A UAV's pose over time [s].
struct Flight {
  std::string name;
  double duration_s = 8.0;
  std::function<Isometry3d(double)> X_WB;
};

/// Hovering still and in wind, turning, creeping, along a line, in a circle.
std::vector<Flight> flights();

/// A straight structural member without end caps.
struct Member {
  Vector3d p_W = Vector3d::Zero();  ///< its middle
  Vector3d direction_W = Vector3d::UnitX();
  double length_m = 2.0, width_m = 0.05;
};

/// A map that uses every single beam, with voxels of 0.5 m everywhere: the reference for the map on board.
agent::WorldMapper::Config exact_map();

class SensedSpace {
 public:
  /// @param lidar  the real LiDAR. Its lost returns are drawn, with seed 1 at first; lost beams see nothing.
  /// @param told   the LiDAR that the map assumes: may differ in `no_return_p` and `dropped_sectors`.
  SensedSpace(const Flight& flight, double servo_phase_s, const agent::WorldMapper::Config& config,
              const LidarConfig& lidar = {}, const LidarConfig& told = {});

  /// Draws the lost returns anew. The map does not change: a LiDAR in empty space gets no returns anyway.
  void lose(std::uint64_t seed);

  const agent::WorldMap& map() const { return mapper_.map(); }
  agent::WorldMap& map() { return mapper_.map(); }
  /// The LiDAR's poses X_WL at all scans.
  const std::vector<Isometry3d>& scans() const { return scans_; }
  double distance_to_route_m(const Vector3d& p_W) const;
  /// Whether a beam hit the part of the member that lies within `reach_m` of the segment a b.
  bool saw(const Member& member, const Vector3d& a_W, const Vector3d& b_W, double reach_m) const;

 private:
  LidarConfig lidar_;
  std::vector<Isometry3d> scans_, inverse_;
  std::vector<Vector3d> beams_L_;        ///< ring by ring
  std::vector<std::vector<bool>> lost_;  ///< by scan and beam: there is no return, whatever the beam hits
  agent::WorldMapper mapper_;

  bool meets(std::size_t scan, const Vector3d& from_W, const Vector3d& to_W, double width_m) const;
};

Vector3d drawn_direction(RandomStream& random);
/// Drawn uniformly from all members that touch the body's tube about the segment a b.
Member drawn_member(RandomStream& random, const Vector3d& a_W, const Vector3d& b_W);

}  // namespace skein::sensing
