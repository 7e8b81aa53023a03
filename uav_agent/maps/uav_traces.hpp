// Finds occupied cubes of the map that may have been a UAV that was not heard, and doubts them once it is heard again.
//
// Where a UAV is known to be, its returns are not taken for structure (beam_scan.hpp). A UAV that is not heard enters
// the map like a wall, and also the maps of those UAVs with which the map is shared. So does a UAV that reports wrong
// positions: once its positions contradict its velocities, it counts as not heard until they have agreed for
// Config::agree_s. Only velocities that it reports count: a velocity that is estimated from its positions lags behind
// them, most of all after a gap. A UAV that reports none contradicts itself if it moves faster than it can fly.
//
// When the UAV is heard again, these cubes are doubted (WorldMap::doubt()): they stay occupied until beams prove anew,
// from zero evidence, that they are free. So if this rule doubts real structure, no thin member is lost: beams hit it
// again, or never prove it free. A trace, a set of cubes that touch each other (26 neighbours), is doubted if all of
// this holds for one UAV:
//   - each cube became occupied while that UAV was not heard, and touches no occupied cube outside the trace;
//   - at the cube's first hit the UAV may have been there: d <= b + v t, where d and t are distance and time since the
//     place where it was heard last, v is its greatest speed and b its body with margins: its radius, half of a cube's
//     diagonal and margin_m. A hit may be late_s older than its exchange, so late_s is added to t;
//   - after the cube's last hit the UAV may have reached the place where it was heard again, by the same bound. So a
//     cube that is hit later, while the UAV is known to be elsewhere, was not a UAV;
//   - at no time was the trace larger than a body: two of its cubes, hit a time t apart, have d <= 2 b + v t. A flying
//     UAV leaves a long trace, but a pole of that length is hit at both ends at once;
//   - it has kMostInTrace cubes at most.
// To be safe, these traces stay in the map: that of a UAV that is never heard again; one that touches structure or the
// ground; one that another UAV's map message reports at once, if it is larger than a body; and one of a UAV
// that the reporting UAV did not hear, but this one heard all the time.
// Frame W.   Units: metres, ticks.   Threads: one.   Deterministic.   Source: none; a rule of Skein.
// Bounded: Config::most_cubes; doubt() keeps a quarter of this number at most, the newest. All other cubes stay
// structure for good.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "uav_agent/api/peers.hpp"
#include "uav_agent/maps/world_map.hpp"

namespace skein::agent {

/// b in the rule above: greatest distance from a UAV's centre to the centre of a cube in which a beam may hit the UAV
/// [m].
double seen_radius_m(double body_radius_m, double cell_m, double margin_m);

class UavTraces {
 public:
  struct Config {
    double margin_m = 0.3;  ///< error of a UAV's reported position and of a beam's hit; chosen
    double late_s = 0.15;   ///< greatest age of a hit at the exchange in which it arrives; chosen
    /// A UAV that is lost again within this time counts as absent throughout: links may flicker. Chosen.
    double settle_s = 2.0;
    /// A UAV that reports positions with a constant offset contradicts itself only when the offset begins and ends. So
    /// traces of offsets that last longer than this stay in the map. Chosen.
    double agree_s = 30.0;
    std::size_t most_cubes = 4096;  ///< memory
  };
  static constexpr std::size_t kMostInTrace = 256;  ///< chosen

  /// @param cell_m  edge of the map's smallest cubes.
  UavTraces(const AgentConfig& agent, double cell_m) : UavTraces(agent, cell_m, Config()) {}
  UavTraces(const AgentConfig& agent, double cell_m, const Config& config);

  /// Notes which UAVs are heard. Call it at each exchange, before its scans and map messages enter the map.
  void update(Tick now, const Peers& peers);
  /// Callback for WorldMap::on_met(). @param news  whether the cube became occupied by this hit.
  void met(const Eigen::Vector3i& cube, bool news);
  /// Doubts the traces of UAVs that are heard again. Call it at each exchange, after all hits are in the map.
  /// @param map  the same at each call: the map that calls met().
  void doubt(WorldMap& map);

  /// Number of cubes that may still be doubted.
  std::size_t cubes() const { return candidates_.size(); }

 private:
  struct Absence {
    Tick lost = 0;  ///< when it was heard last
    Vector3d p_lost_W = Vector3d::Zero();
    std::optional<Tick> found = {};  ///< when it was heard again
    Vector3d p_found_W = Vector3d::Zero();
    bool wrong = false;  ///< whether it was heard, but reported wrong positions
  };
  struct Uav {
    double body_m = 0.0;  ///< b in the rule above
    double max_speed_mps = 0.0;
    Tick heard = 0;
    Vector3d p_W = Vector3d::Zero();
    std::optional<Vector3d> v_W = {};  ///< nullopt: it reported no velocity
    /// Motion of the reported positions less that of the reported velocities, or, without these, less what the greatest
    /// speed allows; older parts fade.
    Vector3d strayed_W = Vector3d::Zero();
    std::optional<Absence> absence;
  };
  struct Candidate {
    Eigen::Vector3i cube = Eigen::Vector3i::Zero();
    Tick first = 0, last = 0;  ///< ticks of the first and the last hit
  };

  /// Whether this holds for one of the UAVs. Asks first about the UAV for which something held last: cubes beside each
  /// other have the same answer, and a fleet may be large.
  template <class Condition>
  bool any_uav(const Condition& holds) const {
    if (likely_ < uavs_.size() && holds(uavs_[likely_])) return true;
    const auto found = std::ranges::find_if(uavs_, holds);
    if (found == uavs_.end()) return false;
    likely_ = static_cast<std::size_t>(found - uavs_.begin());
    return true;
  }
  Vector3d middle_W(const Eigen::Vector3i& cube) const;
  /// Takes over what the UAV reports. @returns whether its positions agree with its velocities.
  bool hear(Uav& uav, const Peer& peer) const;
  /// Whether the UAV can have flown from a_W to b_W in `after` ticks: d <= b + v t.
  bool reaches(const Uav& uav, const Vector3d& a_W, const Vector3d& b_W, Tick after) const;
  bool came_to(const Uav& uav, const Candidate& candidate) const;
  bool went_from(const Uav& uav, const Candidate& candidate) const;
  bool fits(const Uav& uav, const Candidate& one, const Candidate& other) const;
  bool was(const Uav& uav, std::span<const Candidate> trace) const;
  /// Connected sets of candidates that touch no other occupied cube, and have at most kMostInTrace cubes.
  std::vector<std::vector<Candidate>> traces(const WorldMap& map) const;
  void keep(std::vector<Candidate> candidates);

  const Config config_;
  double cell_m_;
  std::vector<Uav> uavs_;           ///< index in the fleet
  mutable std::size_t likely_ = 0;  ///< see any_uav()
  Tick now_ = 0;
  Tick look_at_ = 0;                   ///< earliest tick of the next look
  std::vector<Candidate> candidates_;  ///< in order of their first hit
  BlockTable<std::uint32_t> place_;    ///< index in candidates_, plus 1; 0: none
};

}  // namespace skein::agent
