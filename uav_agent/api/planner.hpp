// The interface that a planner implements, and the registry that finds it by name.
//
// A planner is one class in one file under planners/: a constructor that takes its Config (and optionally the
// AgentConfig), plan(), and SKEIN_REGISTER_PLANNER("name", Class) in namespace skein::agent. It must be deterministic:
// its output may depend only on its present and past inputs. It bounds its effort by counts, never by time.
// The agent, the on-board software of one UAV ("this UAV"), calls plan() once per exchange (also called step): every
// AgentConfig::exchange_period_s of simulated time.
// Frames: W world (ENU), B body (FLU).   Units: SI and radians.   Threads: one planner is used by one thread.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/config/config_reader.hpp"
#include "core/messages/hand_command.hpp"
#include "core/messages/uav_status.hpp"
#include "uav_agent/api/agent_config.hpp"
#include "uav_agent/api/beam_scan.hpp"
#include "uav_agent/api/goals.hpp"
#include "uav_agent/api/messages.hpp"
#include "uav_agent/api/motion.hpp"
#include "uav_agent/api/peers.hpp"
#include "uav_agent/api/strategy_registry.hpp"
#include "uav_agent/api/work_parts.hpp"

namespace skein::agent {

class FreeSpace;      // flight/free_space.hpp
class OccupancyMap;   // maps/occupancy_map.hpp
class WorldMap;       // maps/world_map.hpp
struct FlightConfig;  // flight_core/flight_config.hpp
class Learner;        // api/learner.hpp

/// Progress of the tracker (flight_core/tracker.hpp) along the last Path.
struct TrackingState {
  Setpoint setpoint;      ///< where the next path would begin; the commanded setpoint follows it smoothly
  std::size_t leg = 0;    ///< index of the waypoint that the UAV flies to; waypoints.size() when done
  bool done = true;       ///< at rest at the end of the path, or there is no path
  bool airborne = false;  ///< a first motion was commanded
};

struct PlannerInput {
  std::uint64_t k = 0;   ///< number of the exchange
  Tick tick = 0;         ///< simulated time
  RigidBodyState state;  ///< of this UAV, by its odometry; velocity in W
  GimbalState gimbal;
  TrackingState tracking;
  const OccupancyMap& map;                    ///< from key frames of all LiDARs in line of sight
  const std::vector<OrientedBox>& boxes;      ///< loose boxes around the structures; empty until received
  const Peers& peers;                         ///< the other UAVs
  std::optional<double> mission_remaining_s;  ///< nullopt before the first takeoff of the fleet
  bool station_linked = false;                ///< the station is in line of sight in this exchange
  std::size_t undelivered_captures = 0;       ///< of this UAV, not yet acknowledged by the station
  std::span<const DetectedPoint> detected;    ///< in the pictures since the last exchange; after a restart: in all
  std::span<const RadioMessage> radio;        ///< received in this exchange
  std::span<const KeyFrame> key_frames = {};  ///< received in this exchange, unfiltered: own first, then others'
  std::span<const Scan> scans = {};           ///< own, since the last exchange; only if wants_scans()
  std::span<const BeamScan> beam_scans = {};  ///< own, since the last exchange; only if wants_beams()
  const WorldMap* world_map = nullptr;  ///< from own beams and others' maps; only if wants_world_map() or flight()
  /// A scan of this UAV's own LiDAR arrived. Always false without wants_beams(), wants_world_map() and flight().
  bool scanned = false;
  FlightState flight = {};                       ///< of the flight core: outcomes of goals, ...; only if flight()
  std::optional<HandCommand> hand = {};          ///< the pilot's new command, if any; only for the planner `hand`
  PoseUncertainty uncertainty = {};              ///< of `state`, as the odometry reports it
  std::optional<BatteryStatus> battery = {};     ///< nullopt: the scenario has no batteries
  std::optional<Vector3d> wind_W = {};           ///< estimated wind velocity [m/s]; nullopt: no wind
  std::optional<LinkQuality> station_link = {};  ///< nullopt: no link to the station, or no path loss (see Peer::link)
  const FreeSpace* space = nullptr;              ///< where the flight core may fly; only if flight()
  WorkParts* parts = nullptr;  ///< for PartTimer: times parts of the planner's work in `skein bench --profile`
};

/// A value that the planner publishes on the topic /<id>/debug/<name>. Faults may wait for it, and properties may refer
/// to it (docs/properties.md).
struct DebugValue {
  std::string name;
  double value = 0.0;
};

struct PlannerOutput {
  Motion motion = {};
  std::optional<double> yaw = {};  ///< [rad] the tracker turns the body to it; only on a Path or Hold
  GimbalAim gimbal = {};           ///< aim of the camera
  bool trigger =
      false;  ///< take a picture now; the first trigger ends the camera's automatic rhythm until the end of the run
  std::vector<RadioMessage> radio = {};  ///< on topics that the scenario lets this UAV send on
  /// Goals, best first: the flight core flies to the first one that it can reach. An empty list: the UAV hovers, and
  /// after 4 s the core begins a recovery behaviour; to wait at a place, make that place a goal. nullopt: the last list
  /// stays. Only if flight(). Then the agent ignores `motion`, and applies `yaw` only in exchanges in which the core
  /// does not turn the UAV itself. The core turns a UAV with a working LiDAR along its path, and any UAV to the yaw of
  /// its goal near the goal; along the way of a goal with a yaw, it does not turn the UAV any more.
  std::optional<std::vector<Goal>> goals = {};
  /// In this exchange. nullopt: the flight core decides by time when it delivers captures. Only if flight().
  std::optional<Stake> stake = {};
  /// Maps received from other UAVs (OccupancyMap::octomap_bytes()); the agent merges them into PlannerInput::map.
  std::vector<std::string> heard_maps = {};
  /// Where this UAV is about to fly: the other UAVs send it map updates about the way there first. Only if
  /// wants_world_map(); with flight(), the flight core sets it. nullopt: the tracker's present setpoint counts.
  std::optional<Vector3d> going_to_W = {};
  /// Why the planner found no path in this exchange; empty if it found or needed none. The agent counts the reasons:
  /// log and report show them.
  std::string no_way = {};
  /// Index in the fleet of the UAV for which this UAV waits in this exchange, for the report.
  std::optional<std::size_t> waits_for = {};
  std::vector<DebugValue> debug = {};  ///< new values; names from Planner::debug_names()
};

class Planner {
 public:
  virtual ~Planner() = default;
  /// Called once per exchange, also before takeoff. References in `input` are valid during the call only.
  virtual PlannerOutput plan(const PlannerInput& input) = 0;
  /// Whether the planner reads all scans of the LiDAR. The agent asks before the first exchange; the answer must not
  /// change. PlannerInput::map does not need them: it uses key frames. The simulator computes scans only if a program
  /// reads them, and they would be most of a run's cost (docs/decisions/0006-scans-on-demand.md).
  virtual bool wants_scans() const { return false; }
  /// Whether the planner reads the beams of all scans, including beams without a return. Asked like wants_scans(), at
  /// the same cost. Only explorers have beams.
  virtual bool wants_beams() const { return false; }
  /// Whether the planner reads the world map, which holds free, occupied and unknown space from all beams. Asked like
  /// wants_scans(), at the same cost on a UAV with a LiDAR. UAVs whose planners want it share their maps by radio, with
  /// up to 20 kB/s per link on /plan; planners do not receive these messages (docs/world-map.md).
  virtual bool wants_world_map() const { return false; }
  /// Parameters of the flight core, if it is to fly this UAV to PlannerOutput::goals; nullptr: no flight core. Asked
  /// before the first exchange; the object must live as long as the planner. The planner then has the world map, too.
  virtual const FlightConfig* flight() const { return nullptr; }
  /// Names of the debug values that it publishes. Asked before the first exchange; the answer must not change.
  virtual std::vector<std::string> debug_names() const { return {}; }
  /// Interface for an external program that controls this planner (api/learner.hpp); nullptr: it decides by itself.
  virtual Learner* learner() { return nullptr; }
};

/// Makes the planner that `spec` names: "hover", "hover:height_m=4,climb_mps=1" or "patrol:params.yaml" (a
/// YAML file with the same keys).
/// @throws InputError when a name or key is unknown (the message has similar or valid ones), a value is invalid, or the
/// file cannot be read.
std::unique_ptr<Planner> make_planner(const std::string& spec, const AgentConfig& agent);

/// Names of all registered planners, sorted.
std::vector<std::string> planner_names();

}  // namespace skein::agent

/// Registers a planner under a name, before main(). Link its file as an object file: from a static library, a linker
/// may leave it out.
#define SKEIN_REGISTER_PLANNER(name, Class) SKEIN_REGISTER_STRATEGY(Planner, name, Class)
