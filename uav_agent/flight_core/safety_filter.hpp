// The one place where a UAV's motion is found safe or not. Everything that a UAV is told to fly goes through it.
//
// Invariant, in each exchange: if the UAV braked from what it is commanded next, then on the way to rest
//   - all about its body would be proved to be free: its radius, kHaloM, and the tracking error;
//   - it would not touch what any other UAV can sweep that brakes from the last word of it.
// A motion is commanded only if the invariant holds after it. Else the UAV goes on slower, or brakes: braking was found
// safe in the exchange before, so it is safe still, unless the world has changed (a new hit, a UAV out of nowhere, a
// restart). Where it is broken so, nothing that breaks it may come nearer; but a UAV that was put down where there
// is less room than kHaloM, beside a wall perhaps, may leave slowly with less (FlightConfig::tight_halo_m), all of it
// proved, until it has had room once. So may one that structure seen since has shut in fly back along its own trail:
// kHaloM is there for what beams may have missed, and nothing was in its way where its body has been.
//
// Two UAVs that both keep it never meet: either could brake at any time, and neither counts on what the other will do.
// In a fleet without a LiDAR nobody can prove anything, nor can a UAV that nobody tells anything: there, what is
// outside all boxes, and off what is known to be occupied, is taken to be free (assume_boxes()).
// Frame W.   Units: SI.   Threads: one.   Deterministic.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "uav_agent/api/agent_config.hpp"
#include "uav_agent/api/peers.hpp"
#include "uav_agent/flight_core/flight_config.hpp"
#include "uav_agent/flight_core/tracker.hpp"
#include "uav_agent/maps/world_map.hpp"

namespace skein::agent {

/// Why a UAV is slower than its path asks for.
struct Held {
  enum class By : std::uint8_t { nothing, unproved, structure, peer };
  By by = By::nothing;
  Vector3d at_W = Vector3d::Zero();      ///< where on its way
  std::optional<std::size_t> peer = {};  ///< which one
};

/// On top of the tracking error [m].
struct ExpectedErrors {
  double seen_m = 0.0;   ///< of structure that the UAV's own LiDAR sees again and again
  double told_m = 0.0;   ///< of structure that others have told of
  double peers_m = 0.0;  ///< of each of two UAVs
};

class SafetyFilter {
 public:
  struct Facts {
    Tick tick = 0;
    const RigidBodyState& state;
    const WorldMap& map;
    const std::vector<OrientedBox>& boxes;
    const Peers& peers;
  };

  /// @param config, agent  must outlive this.
  SafetyFilter(const FlightConfig& config, const AgentConfig& agent);

  /// Lets the tracker go on by one exchange, as fast as is safe.   @param most_mps  and no faster than that.
  /// @param retraces  it flies back along its own trail: its body has been there.
  std::optional<TrajectoryCommand> step(Tracker& tracker, const Facts& facts, double most_mps, bool retraces = false);

  /// From now on, bodies are off by so much more than their tracking error.
  void expect(const ExpectedErrors& errors) { errors_ = errors; }
  /// From now on, what is outside all boxes is taken to be free, or not.
  void assume_boxes(bool assume) { assumes_boxes_ = assume; }
  bool assumes_boxes() const { return assumes_boxes_; }
  /// Of the last step.
  const Held& held() const { return held_; }
  /// Whether a body may be there: all about it is proved to be free.
  bool proved(const Vector3d& p_W, const WorldMap& map, const std::vector<OrientedBox>& boxes) const;
  /// Radius of what must be free about a body's centre at a speed.
  double tube_m(double speed_mps) const { return tube_m(speed_mps, kHaloM); }
  /// The same about another UAV at rest that has no LiDAR, and flies by what this one tells it.
  double tube_of_told_m(std::size_t uav) const;

  /// How far this UAV's centre is kept off another one's: bodies, both tracking errors, and a margin.
  double apart_m(std::size_t uav, double speed_mps) const;

  struct Counts {
    std::uint64_t exchanges = 0, slowed = 0, broken = 0;  ///< broken: the invariant did not hold beforehand
  };
  const Counts& counts() const { return counts_; }

 private:
  /// What a UAV sweeps that brakes from the last word of it.
  struct PeerReach {
    std::size_t uav = 0;
    Vector3d from_W, to_W;  ///< of its centre
    double apart_m = 0.0;   ///< centres must stay so far off
    double now_m = 0.0;     ///< from this UAV to all that the peer sweeps
    double from_m = 0.0;    ///< from this UAV to from_W
  };
  using Cube = WorldMap::Cube;

  double tube_m(double speed_mps, double halo_m) const;
  double tracking_error_m(Role role, double speed_mps) const;
  bool has_room(const Facts& facts) const;
  std::vector<PeerReach> reach_of_peers(const Facts& facts) const;
  std::optional<TrajectoryCommand> move_on(Tracker& tracker, const Facts& facts, double most_mps,
                                           const std::vector<PeerReach>& peers);
  Held judge(const std::vector<Vector3d>& way_W, double speed_mps, const Facts& facts,
             const std::vector<PeerReach>& peers);
  bool proved(const Vector3d& p_W, double radius_m, const Facts& facts, Held& held);
  bool assumed(const Vector3d& p_W, double radius_m, const WorldMap& map, const std::vector<OrientedBox>& boxes) const;

  const FlightConfig& config_;
  const AgentConfig& agent_;
  bool assumes_boxes_;
  ExpectedErrors errors_;
  Held held_;
  Counts counts_;
  std::vector<Cube> cubes_;  ///< scratch
  /// Where it is commanded to be: what may not come nearer is measured from there. From the measured place, a UAV that
  /// swings about it would creep.
  Vector3d now_W_ = Vector3d::Zero();
  double halo_m_ = kHaloM;  ///< in this exchange
  bool had_room_ = false;   ///< once since it was put down, or its program began
};

}  // namespace skein::agent
