// The interface that a planner implements, and the registry that finds it by name.
//
// A planner is one class in one file under planners/: a constructor that takes its Config (and, if it wants, the
// AgentConfig), plan(), and SKEIN_REGISTER_PLANNER("name", Class) in namespace skein::agent. It is pure: what it
// returns may depend only on its inputs and on its own past; it bounds its effort by counts, never by time.
// Frames: W world (ENU), B body (FLU).   Units: SI and radians.   Threads: one planner is used by one thread.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/config/config_reader.hpp"
#include "core/hand_command.hpp"
#include "core/told_state.hpp"
#include "uav_agent/api/agent_config.hpp"
#include "uav_agent/api/beam_scan.hpp"
#include "uav_agent/api/goals.hpp"
#include "uav_agent/api/messages.hpp"
#include "uav_agent/api/motion.hpp"
#include "uav_agent/api/peers.hpp"
#include "uav_agent/api/strategy_registry.hpp"

namespace skein::agent {

class FreeSpace;      // flight/free_space.hpp
class OccupancyMap;   // maps/occupancy_map.hpp
class WorldMap;       // maps/world_map.hpp
struct FlightConfig;  // flight_core/flight_config.hpp
class Learner;        // api/learner.hpp

/// How far the tracker has come with the last Path.
struct TrackingState {
  Setpoint setpoint;      ///< where the next path begins; what is commanded follows it smoothly (tracker.hpp)
  std::size_t leg = 0;    ///< index of the waypoint being flown to; waypoints.size() when done
  bool done = true;       ///< at rest at the end of the path, or no path
  bool airborne = false;  ///< a first motion was commanded
};

struct PlannerInput {
  std::uint64_t k = 0;  ///< exchange
  Tick tick = 0;
  RigidBodyState state;  ///< own; velocity in W
  GimbalState gimbal;
  TrackingState tracking;
  const OccupancyMap& map;
  const std::vector<OrientedBox>& boxes;  ///< empty until received
  const Peers& peers;
  std::optional<double> mission_remaining_s;  ///< nullopt before the first take-off
  bool station_linked = false;                ///< direct link at this step
  std::size_t undelivered_captures = 0;
  std::span<const DetectedPoint> detected;    ///< in this step's pictures; after a restart all that it ever saw
  std::span<const RadioMessage> radio;        ///< received at this step
  std::span<const KeyFrame> key_frames = {};  ///< that came at this step, as the LiDARs saw them: own, then neighbours'
  std::span<const Scan> scans = {};           ///< own, since the step before; only if wants_scans()
  std::span<const BeamScan> beam_scans = {};  ///< own, since the step before; only if wants_beams()
  const WorldMap* world_map = nullptr;        ///< what beams have proved to be free; only if wants_world_map()
  bool scanned = false;                       ///< the own LiDAR told something since the step before
  FlightState flight = {};                    ///< what became of its goals; only if flight() is given
  std::optional<HandCommand> hand = {};       ///< news of who flies it by hand; only for planners named "hand"
  PoseUncertainty uncertainty = {};           ///< of `state`; as the odometry says
  std::optional<BatteryStatus> battery = {};  ///< nullopt: this world has no batteries
  std::optional<Vector3d> wind_W = {};        ///< estimated velocity of the air [m/s]; nullopt: there is no wind
  const FreeSpace* space = nullptr;           ///< where the flight core may fly it; only if flight() is given
};

/// What a planner tells of itself, as /<id>/debug/<name>: faults may wait for it and properties be about it
/// (docs/properties.md).
struct DebugValue {
  std::string name;
  double value = 0.0;
};

struct PlannerOutput {
  Motion motion = {};
  std::optional<double> yaw = {};  ///< body yaw to turn to at the tracker's rate; only with a Path or Hold
  GimbalAim gimbal = {};
  bool trigger = false;                  ///< ask for a capture; only where the camera is in manual mode
  std::vector<RadioMessage> radio = {};  ///< on topics that the scenario lets this UAV send on
  /// Where it wants to go, what it likes best first: the flight core flies to the first that can be reached. None: it
  /// rests, and after some seconds is taken to where more may be seen; to wait at a place, want that place. nullopt: as
  /// before. Only if flight() is given; then `motion` is not looked at, and `yaw` only while the
  /// core does not turn the UAV itself: it turns one with a LiDAR, but not along a goal's way that has a yaw.
  std::optional<std::vector<Goal>> goals = {};
  /// What others said of their maps (OccupancyMap::octomap_bytes()), to be taken into the one on board.
  std::vector<std::string> heard_maps = {};
  /// Where it is about to fly: others tell its UAV soonest what they know of the way there, if it wants_world_map().
  /// While it does not say, they take where the tracker has it fly just now.
  std::optional<Vector3d> going_to_W = {};
  /// Why it found no way in this exchange, if it looked for one: counted by reason, and told in log and report.
  std::string no_way = {};
  /// A UAV of the fleet for which its strategy lets it wait in this exchange: the report says so.
  std::optional<std::size_t> waits_for = {};
  std::vector<DebugValue> debug = {};  ///< of Planner::debug_names()
};

class Planner {
 public:
  virtual ~Planner() = default;
  /// Called once per exchange, also before take-off. What `input` refers to is gone afterwards.
  virtual PlannerOutput plan(const PlannerInput& input) = 0;
  /// Whether it looks at the LiDAR's scans; asked before the first exchange, and the answer must stay the same. The map
  /// has what key frames show without them. A scan that nobody reads is not even computed, and that is most of a run's
  /// cost (docs/decisions/0006-scans-on-demand.md).
  virtual bool wants_scans() const { return false; }
  /// Whether it looks at the beams of the scans, those without a return among them; asked as wants_scans() is, and at
  /// the same price. Only explorers have any.
  virtual bool wants_beams() const { return false; }
  /// Whether it looks at the map of what is free, occupied and unknown by all beams; asked as wants_scans() is, and at
  /// the same price where there is a LiDAR. UAVs whose planners want it tell each other what they know by radio, by up
  /// to 20 kB/s a link on /plan, and no planner sees these messages (docs/decisions/0027-maps-told-by-radio.md). In a
  /// fleet of more than 127 UAVs a planner that wants it is refused.
  virtual bool wants_world_map() const { return false; }
  /// How it flies, if the flight core flies it (PlannerOutput::goals); asked before the first exchange, and it must
  /// outlive all. A planner that is flown has the world map, too.
  virtual const FlightConfig* flight() const { return nullptr; }
  /// Names of the values that it publishes; asked before the first exchange, and the answer must stay the same.
  virtual std::vector<std::string> debug_names() const { return {}; }
  /// What it is to a program outside that tells it in each step what to do; nullptr: it decides by itself.
  virtual Learner* learner() { return nullptr; }
};

/// Makes the planner that `spec` names: "hover", "hover:height_m=4,climb_mps=1" or "patrol:params.yaml" (a
/// YAML file with the same keys).
/// @throws InputError naming the planner or key that is unknown, and those that exist.
std::unique_ptr<Planner> make_planner(const std::string& spec, const AgentConfig& agent);

/// Names of all registered planners, sorted.
std::vector<std::string> planner_names();

}  // namespace skein::agent

/// Registers a planner under a name, before main(). Its file must be linked as an object, not from a static
/// library.
#define SKEIN_REGISTER_PLANNER(name, Class) SKEIN_REGISTER_STRATEGY(Planner, name, Class)
