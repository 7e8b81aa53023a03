// One UAV's on-board software without its transport: map, peers, planner, tracking, delivery of captures.
// agent_node feeds it once per exchange from DDS topics and publishes what it returns; tests feed it by hand.
// Pure and deterministic: same inputs, same outputs. Frame W.   Units: SI and radians.   Threads: one.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/activity.hpp"
#include "core/run/work_time.hpp"
#include "core/told_state.hpp"
#include "uav_agent/api/agent_config.hpp"
#include "uav_agent/api/messages.hpp"
#include "uav_agent/api/planner.hpp"
#include "uav_agent/flight_core/safety_filter.hpp"
#include "uav_agent/onboard/ready_frames.hpp"
#include "uav_agent/onboard/uplink.hpp"

namespace skein::agent {

/// All that arrived for one exchange.
struct AgentInput {
  std::uint64_t k = 0;
  Tick tick = 0;
  RigidBodyState state;                 ///< odometry, twist already turned into W
  std::optional<Tick> state_tick = {};  ///< when that was so; nullopt: at this tick
  PoseUncertainty uncertainty;          ///< of the odometry
  std::optional<BatteryStatus> battery;
  std::optional<Vector3d> wind_W;  ///< estimated velocity of the air
  GimbalState gimbal;
  std::optional<double> mission_remaining_s;  ///< nullopt before the first take-off
  std::vector<OrientedBox> boxes;             ///< when they arrived at this step; else empty
  std::vector<Neighbour> neighbours;          ///< in line of sight now
  std::vector<KeyFrame> key_frames;           ///< in order: own first, then neighbours'
  std::vector<Scan> scans;                    ///< own; only if wants_scans() or wants_beams()
  std::vector<LidarServo> servos;             ///< own, in their order; only if wants_beams()
  std::vector<DetectedPoint> detected;
  std::vector<HandedOut> capture_reports;   ///< from the camera; it may repeat unacknowledged ones
  std::vector<std::uint64_t> capture_acks;  ///< capture numbers that the station has journalled
  std::vector<RadioMessage> radio;          ///< of other UAVs: of their planners, and what they tell of their maps
  std::optional<HandCommand> hand;          ///< news of who flies it by hand; the last of a step
};

struct AgentOutput {
  /// nullopt before the first motion, and where a planner that commands by itself says nothing (motion.hpp).
  std::optional<TrajectoryCommand> trajectory;
  std::optional<GimbalCommand> gimbal;
  bool trigger = false;
  std::vector<RadioMessage> radio;
  std::vector<std::uint64_t> captures;  ///< whose reports to send to the station now
  std::vector<DebugValue> debug;        ///< of the planner
  std::optional<Activity> activity;     ///< what it does, when that is news; without its CPU time
};

class Agent {
 public:
  /// @param planner decides; see make_planner().
  /// @param frames  shared by the agents of this process; nullptr: this one works them out for itself.
  /// @throws std::invalid_argument when the planner wants the world map in a fleet of more than kMostUavs.
  Agent(const AgentConfig& config, std::unique_ptr<Planner> planner, std::shared_ptr<ReadyFrames> frames = nullptr);
  ~Agent();
  Agent(Agent&&) noexcept;
  Agent& operator=(Agent&&) noexcept;

  /// Whether the planner looks at scans: nobody needs to compute them or send them otherwise.
  bool wants_scans() const;
  /// Whether it looks at their beams, or at the map of them, for which scans and the servo's angles are needed.
  bool wants_beams() const;
  /// Names of what the planner tells of itself.
  std::vector<std::string> debug_names() const;
  /// One exchange. Inputs must come in order of k.
  AgentOutput step(const AgentInput& input);
  /// What its planner is to a program outside that tells it what to do; nullptr: its planner decides by itself.
  Learner* learner();
  /// The first half of step(), in which all is taken in; then the learner looks. step() with the same input, which must
  /// be there until then, does the rest.
  void look(const AgentInput& input);
  /// Scans whose beams were asked for, by what was wrong with them.
  std::uint64_t beam_scans(ScanDoubt doubt) const;
  /// Whether that capture's report may yet have to be sent.
  bool holds_capture(std::uint64_t capture) const;
  /// Captures whose reports the station has not acknowledged.
  std::size_t undelivered() const;
  /// How often the safety filter has intervened; nullptr: no flight core flies the planner.
  const SafetyFilter::Counts* filter_counts() const;
  const OccupancyMap& map() const;
  /// That of all beams, on which its planner flies; nullptr: its planner uses none.
  const WorldMap* world_map() const;
  /// Why its planner found no ways (PlannerOutput::no_way), and how often.
  const std::map<std::string, std::uint64_t>& no_ways() const;
  /// The reason in the last exchange; empty: there was none.
  const std::string& no_way() const;
  /// How long its planner has waited for other UAVs (PlannerOutput::waits_for) [s].
  double waited_s() const;
  /// When it did, and for whom, as index in the fleet; breaks of half a second or less are none.
  const std::vector<WaitSpan>& waits() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace skein::agent
