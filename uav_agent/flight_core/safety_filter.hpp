// The only place that decides whether a motion is safe. All paths and stops of the flight core pass through it.
//
// Invariant, in each exchange: if the UAV braked after its next command, then on its braking trajectory
//   - a sphere about it would be proved free, whose radius is that of the body plus kHaloM plus the tracking error;
//   - it would stay clear of the space that any other UAV sweeps if that UAV brakes, by its last known state.
// The filter commands a motion only if the invariant holds after it. Otherwise the UAV slows down or brakes. Braking
// was safe in the exchange before, so it still is, unless the known world has changed (a new hit, a UAV that came into
// sight, a restart). Then the invariant may be broken, and the UAV may not come nearer to what breaks it. Two
// exceptions need less than kHaloM, but all of it proved free, and are slow (FlightConfig::tight_halo_m, tight_mps):
//   - a UAV whose start has less room, beside a wall perhaps, until it has had full room once;
//   - a UAV that flies back along its own trail. kHaloM allows for structure that beams have missed, but where the
//     UAV's body has been, there is none.
//
// Two UAVs that both keep the invariant never meet: either may brake at any time, and neither relies on the other.
// A UAV that must get down, since it would fall otherwise, requires less (Trust).
// In a fleet without a LiDAR, no UAV can prove space free; nor can a UAV without a working LiDAR that receives no map.
// Such a UAV assumes that space is free outside all boxes and away from known structure (assume_boxes()). If it starts
// in a box, it has no other way out than straight up, so it assumes that this way is free, too.
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

/// The reason why a UAV is slower than its path asks for.
struct Held {
  enum class By : std::uint8_t { nothing, unproved, structure, peer };
  By by = By::nothing;
  Vector3d at_W = Vector3d::Zero();      ///< first place on its braking trajectory that is not safe
  std::optional<std::size_t> peer = {};  ///< if `by` is peer: its index in the fleet
};

/// Position errors that add to the tracking error [m] (caution.hpp).
struct ExpectedErrors {
  double seen_m = 0.0;    ///< of structure that the UAV's own LiDAR sees
  double told_m = 0.0;    ///< of structure on maps that other UAVs sent
  double ground_m = 0.0;  ///< of the height in which the ground was seen
  /// Between this UAV and each other one, by index in the fleet, along each axis; empty: none.
  std::vector<Vector3d> peers_m = {};
};

class SafetyFilter {
 public:
  /// The inputs of the filter in one exchange; valid during step().
  struct Facts {
    Tick tick = 0;
    const RigidBodyState& state;
    const WorldMap& map;
    const std::vector<OrientedBox>& boxes;
    const Peers& peers;
  };

  /// @param config, agent  must outlive this.
  SafetyFilter(const FlightConfig& config, const AgentConfig& agent);

  /// Advances the tracker by one exchange, as fast as is safe. Only Path and Hold are filtered.
  /// @param most_mps  speed limit.   @param retraces  the UAV flies back along its own trail.
  std::optional<TrajectoryCommand> step(Tracker& tracker, const Facts& facts, double most_mps, bool retraces = false);

  /// Sets the errors that add to the tracking errors from now on.
  void expect(const ExpectedErrors& errors) { errors_ = errors; }
  /// Whether space outside all boxes is assumed to be free from now on.
  void assume_boxes(bool assume) { assumes_boxes_ = assume; }
  bool assumes_boxes() const { return assumes_boxes_; }
  /// Place straight above the start at which this UAV has left the boxes in which it starts; nullopt: it starts in no
  /// box, or does not assume_boxes().
  std::optional<Vector3d> way_out_W(const std::vector<OrientedBox>& boxes) const;
  /// The filter's assumptions for a UAV that must get down: its battery is nearly empty, or it gave up a takeoff.
  enum class Trust : std::uint8_t {
    proved,   ///< the usual rules
    start,    ///< unknown space counts as free, and UAVs at their starts do not keep this UAV from sinking beside them
    unknown,  ///< unknown space counts as free
    all,      ///< like `unknown`, positions count as exact, and tight_halo_m replaces kHaloM and peer_margin_m
  };
  void set_trust(Trust trust) { trust_ = trust; }
  Trust trust() const { return trust_; }
  /// Call it before another takeoff: until the UAV has had room in flight again, it needs as little as at its start.
  void begin_anew() { had_room_ = false; }
  /// The reason why the last step() slowed the UAV down, or why it would be held according to the last clear_up_to().
  const Held& held() const { return held_; }
  /// Whether this UAV may rest at p_W (centre): all space about it that the invariant needs is proved free.
  bool proved(const Vector3d& p_W, const WorldMap& map, const std::vector<OrientedBox>& boxes) const;
  /// The same, whatever the filter assumes.
  bool proved_free(const Vector3d& p_W, const WorldMap& map) const;
  /// The reason why this UAV would be held if it flew slowly from where it is through some places; By::nothing: it
  /// would not be held.
  Held would_hold(const std::vector<Vector3d>& corners_W, const Facts& facts);
  /// Whether this UAV, which stands on the ground, could climb straight up to a height [m] without being held.
  bool clear_up_to(double height_m, const Facts& facts);
  /// Space below this height need not be proved free: what was seen there may be the ground.
  double ground_m() const { return config_.ground_m + errors_.ground_m; }
  /// Radius of the sphere that must be free about this UAV's centre at a speed [m].
  double tube_m(double speed_mps) const { return tube_m(speed_mps, kHaloM); }
  /// The same for another UAV at rest that has no LiDAR, and relies on the map of this UAV.
  double tube_of_told_m(std::size_t uav) const;

  /// Minimum distance of the centres of this and another UAV that is in a direction [m]: both bodies,
  /// both errors, and a margin.
  double apart_m(std::size_t uav, double speed_mps, const Vector3d& direction_W) const;
  /// The greatest of these over all directions.
  double apart_m(std::size_t uav, double speed_mps) const;

  /// Numbers of exchanges on a Path or Hold: all; those in which the filter made the UAV brake; those in which the
  /// space about the UAV's commanded position was not proved free beforehand.
  struct Counts {
    std::uint64_t exchanges = 0, slowed = 0, broken = 0;
  };
  const Counts& counts() const { return counts_; }

 private:
  /// Space that another UAV sweeps if it brakes, by its last known state: a segment.
  struct PeerReach {
    std::size_t uav = 0;
    Vector3d from_W, to_W;  ///< of its centre: last known position, and where it comes to rest
    double apart_m = 0.0;   ///< minimum distance of this UAV's centre from the segment, if positions were exact
    Vector3d error_m = Vector3d::Zero();  ///< ExpectedErrors::peers_m
    double now_m = 0.0;                   ///< distance from now_W_ to the segment
    double from_m = 0.0;                  ///< distance from now_W_ to from_W
  };
  using Cube = WorldMap::Cube;

  double tube_m(double speed_mps, double halo_m) const;
  double tracking_error_m(Role role, double speed_mps) const;
  double apart_if_exact_m(std::size_t uav, double speed_mps) const;
  Vector3d error_of_m(std::size_t uav) const;
  bool has_room(const Facts& facts) const;
  Vector3d certain_W(const Vector3d& a_W) const;
  bool stands(const Peer& peer) const;
  bool is_at_start(const Peer& peer) const;
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
  Trust trust_ = Trust::proved;
  ExpectedErrors errors_;
  Held held_;
  Counts counts_;
  std::vector<Cube> cubes_;  ///< scratch
  /// The commanded position in flight, else the measured one. The filter judges from it whether the UAV comes nearer to
  /// something. Judged from its measured position, a UAV that swings about its setpoint would advance only at a crawl.
  Vector3d now_W_ = Vector3d::Zero();
  double nearer_m_;         ///< a place that is nearer by less does not count as nearer, because of rounding and noise
  double halo_m_ = kHaloM;  ///< the one that applies in this exchange
  bool had_room_ = false;   ///< away from the start, the full kHaloM was free once since the start or restart
};

}  // namespace skein::agent
