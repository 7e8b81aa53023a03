// Which occupied cubes may have been a UAV that was out of sight, and are to be doubted once it is heard again.
//
// What beams meet where a UAV is known to be is no structure (beam_scan.hpp). One that is not heard comes into the map
// like a wall, and so it does into the maps of those that are told. When it is heard again, these cubes are doubted
// (WorldMap::doubt()): they stay occupied, until beams prove from nothing that they are free. So a rule that takes too
// much for a UAV costs no member its place: what stands there is met again, or never proved free. A set of cubes that
// touch each other (26 neighbours) is doubted if all of this holds:
//   - each became occupied while that UAV was not heard, and touches nothing that was occupied before;
//   - at the time of its first hit the UAV may have been there, coming from where it was heard last: at the distance d,
//     after the time t, with d <= b + v t, where v is its greatest speed and b its body with margins: its radius, half
//     of a cube's diagonal and margin_m. Hits are up to late_s older than they seem to be, which counts for t;
//   - after its last hit it may have come to where it was heard again, by the same bound. So what is hit later, while
//     the UAV is known to be elsewhere, was no UAV;
//   - at no time was it larger than a body: two of its cubes, hit a time t apart, have d <= 2 b + v t. A UAV that flies
//     leaves a long trace, but a pole of that length is hit at both ends at once;
//   - it has kMostInTrace cubes at most.
// Stays in the map, on the safe side: the trace of a UAV that is never heard again, or that touches structure or the
// ground; one that others tell all at once, if it is larger than a body; and one that was told by a UAV that did not
// hear what this one heard all the time.
// Frame W.   Units: metres, ticks.   Threads: one.   Deterministic.
// Bounded: Config::most_cubes.   Where there are more, those that became occupied first are structure.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "uav_agent/api/peers.hpp"
#include "uav_agent/maps/world_map.hpp"

namespace skein::agent {

class UavTraces {
 public:
  struct Config {
    double margin_m = 0.3;  ///< of where a UAV says that it is, and of what a beam meets
    double late_s = 0.15;   ///< hits are at most so much older than the exchange in which they come
    /// A UAV that falls silent again so soon after it was heard was out of sight all the time: links may flicker.
    double settle_s = 2.0;
    std::size_t most_cubes = 4096;
  };
  static constexpr std::size_t kMostInTrace = 256;

  /// @param cell_m  of the map's smallest cubes.
  UavTraces(const AgentConfig& agent, double cell_m) : UavTraces(agent, cell_m, Config()) {}
  UavTraces(const AgentConfig& agent, double cell_m, const Config& config);

  /// Who is heard: at each exchange, before its scans and what others told are taken into the map.
  void update(Tick now, const Peers& peers);
  /// For WorldMap::on_met().
  void met(const Eigen::Vector3i& cube, bool news);
  /// Doubts what may have been a UAV that is heard again: at each exchange, after all is in the map.
  /// @param map  the same at each call, whose cubes met() is told.
  void doubt(WorldMap& map);

  /// Cubes that may yet be doubted.
  std::size_t cubes() const { return candidates_.size(); }

 private:
  struct Absence {
    Tick lost = 0;  ///< when it was heard last
    Vector3d p_lost_W = Vector3d::Zero();
    std::optional<Tick> found;  ///< when it was heard again
    Vector3d p_found_W = Vector3d::Zero();
  };
  struct Uav {
    double body_m = 0.0;  ///< b of above
    double max_speed_mps = 0.0;
    Tick heard = 0;
    Vector3d p_W = Vector3d::Zero();
    std::optional<Absence> absence;
  };
  struct Candidate {
    Eigen::Vector3i cube = Eigen::Vector3i::Zero();
    Tick first = 0, last = 0;  ///< when it was hit
  };

  Vector3d middle_W(const Eigen::Vector3i& cube) const;
  /// Whether a UAV can have come from one place to the other, within margins.
  bool reaches(const Uav& uav, const Vector3d& a_W, const Vector3d& b_W, Tick after) const;
  bool came_to(const Uav& uav, const Candidate& candidate) const;
  bool went_from(const Uav& uav, const Candidate& candidate) const;
  bool fits(const Uav& uav, const Candidate& one, const Candidate& other) const;
  bool was(const Uav& uav, std::span<const Candidate> trace) const;
  /// What touches each other and nothing else that is occupied, and is not too large.
  std::vector<std::vector<Candidate>> traces(const WorldMap& map) const;
  void keep(std::vector<Candidate> candidates);

  const Config config_;
  double cell_m_;
  std::vector<Uav> uavs_;  ///< by UAV
  Tick now_ = 0;
  Tick look_at_ = 0;                   ///< not before
  std::vector<Candidate> candidates_;  ///< in the order in which they came
  BlockTable<std::uint32_t> place_;    ///< in candidates_, from 1 on; 0: none
};

}  // namespace skein::agent
