// One UAV's on-board software without its transport: map, peers, planner, tracking, delivery of captures.
// Once per exchange, agent_node passes it the input from DDS topics and publishes its output; tests call it directly.
// Pure and deterministic: same inputs, same outputs. Frame W.   Units: SI and radians.   Threads: one.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/messages/activity.hpp"
#include "core/messages/uav_status.hpp"
#include "core/run/work_time.hpp"
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
  RigidBodyState state;                 ///< odometry, twist already in W
  std::optional<Tick> state_tick = {};  ///< tick of the odometry; nullopt: this tick
  PoseUncertainty uncertainty;          ///< of the odometry
  std::optional<BatteryStatus> battery;
  std::optional<Vector3d> wind_W;  ///< estimated velocity of the air [m/s]
  GimbalState gimbal;
  std::optional<double> mission_remaining_s;  ///< nullopt before the first takeoff of the fleet
  std::vector<OrientedBox> boxes;             ///< if they arrived in this step; else empty
  std::vector<Neighbour> neighbours;          ///< odometry of the nodes in line of sight now
  LinkQualities links;                        ///< quality of their links; empty without path loss
  std::vector<KeyFrame> key_frames;           ///< in order: own first, then neighbours'
  std::vector<Scan> scans;                    ///< own; only if wants_scans() or wants_beams()
  std::vector<LidarServo> servos;             ///< own, in order of time; only if wants_beams()
  std::vector<DetectedPoint> detected;
  std::vector<HandedOut> capture_reports;   ///< from the camera; it may repeat unacknowledged ones
  std::vector<std::uint64_t> capture_acks;  ///< capture numbers that the station has journalled
  std::vector<RadioMessage> radio;          ///< from other UAVs: messages of their planners and of map sharing
  std::optional<HandCommand> hand;          ///< the last command of the pilot in this step; only for the planner `hand`
};

struct AgentOutput {
  /// nullopt before the first motion, and in exchanges in which a planner that sends its own TrajectoryCommands sends
  /// none (motion.hpp).
  std::optional<TrajectoryCommand> trajectory;
  std::optional<GimbalCommand> gimbal;
  bool trigger = false;
  std::vector<RadioMessage> radio;
  std::vector<std::uint64_t> captures;  ///< captures whose reports are to be sent to the station now
  std::vector<DebugValue> debug;        ///< values that the planner publishes
  std::optional<Activity> activity;     ///< what the UAV does, if a message is due; without cpu_s
};

class Agent {
 public:
  /// @param planner see make_planner().
  /// @param frames  cache of prepared key frames, shared by the agents of this process; nullptr: none.
  Agent(const AgentConfig& config, std::unique_ptr<Planner> planner, std::shared_ptr<ReadyFrames> frames = nullptr);
  ~Agent();
  Agent(Agent&&) noexcept;
  Agent& operator=(Agent&&) noexcept;

  /// Whether the planner uses LiDAR scans; if not, the server need not compute or send them.
  bool wants_scans() const;
  /// Whether the agent needs scans and the servo's angles to reconstruct all beams: for the planner or for the world
  /// map.
  bool wants_beams() const;
  /// Names of the values that the planner publishes.
  std::vector<std::string> debug_names() const;
  /// From now on, times the parts of its work: by the CPU time of the thread that calls step(). Outputs do not change.
  void time_parts(WorkParts::Clock clock);
  /// The parts of its work; nullptr: they are not timed.
  const WorkParts* parts() const;
  /// One exchange. Inputs must come in order of k.
  AgentOutput step(const AgentInput& input);
  /// The first half of step(): updates map and peers, and lets the learner look. Only if the planner is a learner
  /// (api/learner.hpp). The next call must be step() with the same input, which does the rest; the input must live
  /// until then.
  void look(const AgentInput& input);
  /// Number of scans whose beams were reconstructed (ScanDoubt::none), or could not be, by reason.
  std::uint64_t beam_scans(ScanDoubt doubt) const;
  /// Whether this capture's report must be kept, because the station has not acknowledged it.
  bool holds_capture(std::uint64_t capture) const;
  /// Number of captures whose reports the station has not acknowledged.
  std::size_t undelivered() const;
  /// How often the safety filter has intervened; nullptr: no flight core flies the planner.
  const SafetyFilter::Counts* filter_counts() const;
  /// The map of key frames.
  const OccupancyMap& map() const;
  /// The world map of all beams; nullptr: neither the planner nor a flight core uses one.
  const WorldMap* world_map() const;
  /// Reasons why no path was found (PlannerOutput::no_way), and in how many exchanges.
  const std::map<std::string, std::uint64_t>& no_ways() const;
  /// The reason in the last exchange; empty: no search for a path failed.
  const std::string& no_way() const;
  /// How long this UAV has waited for other UAVs (PlannerOutput::waits_for) [s].
  double waited_s() const;
  /// Begin and end of each wait, and the index in the fleet of the UAV waited for. Waits for the same UAV with a break
  /// of at most 0.5 s between them are one.
  const std::vector<WaitSpan>& waits() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace skein::agent
