// The table of all topics that Skein itself defines (name, type, direction, quality of service), and the numbers of the
// DDS domains. For radio topics see core/radio/radio_routes.hpp, for the fields of PointCloud2 core/cloud_layouts.hpp.
//
// Users write ROS names ("/jurong/gimbal") and ROS types ("nav_msgs/msg/Odometry"). On the wire, DDS uses wire names
// ("rt/jurong/gimbal") and wire types ("nav_msgs::msg::dds_::Odometry_"). All topics are RELIABLE and KEEP_LAST.
// Pure; safe from any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/cloud_layouts.hpp"
#include "core/types.hpp"

namespace skein {

struct Scenario;

/// Whether `text` is an absolute ROS topic name: "/x", "/x/y".
bool is_topic_name(std::string_view text);
/// Longest name of a DDS topic or type: Fast DDS cuts longer names off, and Cyclone DDS crashes at 64 KiB.
inline constexpr std::size_t kMostNameBytes = 255;
/// "/x" -> "rt/x". @throws InputError when `ros_topic` is not an absolute ROS topic name, or too long.
std::string wire_topic(std::string_view ros_topic);
/// "std_msgs/msg/String" -> "std_msgs::msg::dds_::String_".
/// @throws InputError when `ros_type` is not of the form package/msg/Type, or too long.
std::string wire_type(std::string_view ros_type);

/// World domain: ground truth; no agent joins it.
constexpr int world_domain(int base) { return base; }
constexpr int gcs_domain(int base) { return base + 1; }
constexpr int uav_domain(int base, UavIndex uav) { return base + 2 + static_cast<int>(uav); }
/// Names of the domains, in the order of their numbers: "world", "gcs", then the UAVs' names.
std::vector<std::string> domain_names(const Scenario& scenario);
/// Domain of a radio node: the ground station's or a UAV's.
constexpr int node_domain(int base, Node node) { return base + 1 + static_cast<int>(node); }

namespace topics {

// ---- one entry of the table ------------------------------------------------------------------------------------

enum class Direction {
  to_agent,        ///< written by sim_server, read by on-board software (or by a program at the ground station)
  from_agent,      ///< written by on-board software, read by sim_server
  shown_by_agent,  ///< written by on-board software into its UAV's domain, for viewers
  from_station,    ///< written by the station into the GCS domain; /viz/scored into the world domain
  to_viewer,       ///< written by sim_server into the world domain, for viewers
  internal,        ///< lock-step, custody and live view: between Skein's own processes and lock-step clients
};

struct TopicInfo {
  std::string_view pattern;  ///< ROS name; {id} stands for the node ("jurong", "gcs")
  std::string_view type;     ///< ROS type
  Direction direction;
  int depth;              ///< history depth; at least the samples of one exchange
  std::string_view rate;  ///< when a sample is written
  bool latched = false;   ///< TRANSIENT_LOCAL
  bool explorers_only = false;
  const CloudLayout* cloud = nullptr;  ///< fields, if the type is PointCloud2
};

/// A topic with its DDS name and DDS type, for one node.
struct WireTopic {
  std::string name, type;
  bool latched = false;
  int depth = 0;
};

/// @param id replaces {id} in the pattern.
WireTopic wire(const TopicInfo& topic, std::string_view id = {});

inline constexpr int kStateDepth = 8;  ///< one sample per exchange
inline constexpr int kCloudDepth = 8;  ///< at most one large sample per exchange
inline constexpr int kCommandDepth = 64;
inline constexpr int kRadioDepth = 256;
/// Number of sources that code assumes for a topic on which all nodes may send, if it does not know the fleet: twenty
/// UAVs and the ground station.
inline constexpr std::size_t kMostRadioSources = 21;
/// History depth where messages of several sources arrive: each source may send kRadioDepth messages in one exchange.
constexpr int radio_depth(std::size_t sources) { return kRadioDepth * static_cast<int>(sources); }

// ---- a UAV's domain --------------------------------------------------------------------------------------------

inline constexpr TopicInfo kOdometry{"/{id}/ground_truth/odometry", "nav_msgs/msg/Odometry", Direction::to_agent,
                                     kStateDepth, "every exchange; twist in the body frame"};
inline constexpr TopicInfo kGimbal{"/{id}/gimbal", "geometry_msgs/msg/TwistStamped", Direction::to_agent, kStateDepth,
                                   "every exchange; angles in linear, rates in angular: y pitch, z yaw"};
/// Only if the scenario's conditions have batteries.
inline constexpr TopicInfo kBattery{"/{id}/battery", "sensor_msgs/msg/BatteryState", Direction::to_agent, kStateDepth,
                                    "every exchange, if there are batteries"};
/// The flight controller's estimate of the wind; only if the scenario's conditions have wind.
inline constexpr TopicInfo kWind{"/{id}/wind", "geometry_msgs/msg/TwistStamped", Direction::to_agent, kStateDepth,
                                 "every exchange, if there is wind; linear: velocity of the air in W"};
/// Measurements of the UAV's radio; only if the scenario's conditions have path loss.
inline constexpr TopicInfo kRadioLinks{"/{id}/radio_links", "skein_msgs/msg/RadioLinks", Direction::to_agent,
                                       kStateDepth, "every exchange, if there is path loss; the open links"};
inline constexpr TopicInfo kCloud{
    "/{id}/cloud_inW", "sensor_msgs/msg/PointCloud2", Direction::to_agent, kCloudDepth, "10 Hz", false, true,
    &kScanLayout};
/// State of the LiDAR's servo at the instant of each scan, also if no program reads the scan.
inline constexpr TopicInfo kLidarServo{
    "/{id}/lidar_servo", "sensor_msgs/msg/JointState", Direction::to_agent, kStateDepth, "10 Hz", false, true};
inline constexpr TopicInfo kSelfKeyframe{
    "/{id}/slf_kf_cloud", "sensor_msgs/msg/PointCloud2", Direction::to_agent, kCloudDepth, "on keyframe", false, true,
    &kScanLayout};
// Every neighbour may deliver its key frame in the same exchange; intensity = node number of the neighbour.
inline constexpr TopicInfo kNeighbourKeyframe{"/{id}/nbr_kf_cloud",
                                              "sensor_msgs/msg/PointCloud2",
                                              Direction::to_agent,
                                              64,
                                              "on the keyframe of a neighbour in LoS",
                                              false,
                                              false,
                                              &kScanLayout};
inline constexpr TopicInfo kNeighbourOdometry{"/{id}/nbr_odom_cloud",
                                              "sensor_msgs/msg/PointCloud2",
                                              Direction::to_agent,
                                              kStateDepth,
                                              "every exchange",
                                              false,
                                              false,
                                              &kNeighbourLayout};
inline constexpr TopicInfo kDetectedPoints{"/{id}/detected_interest_points",
                                           "sensor_msgs/msg/PointCloud2",
                                           Direction::to_agent,
                                           kCloudDepth,
                                           "every capture that found something: all that this UAV ever saw",
                                           false,
                                           false,
                                           &kDetectionLayout};
/// For Skein's own agents: as kDetectedPoints, but a sample has only the points that changed.
inline constexpr TopicInfo kDetected{"/skein/detected",
                                     "sensor_msgs/msg/PointCloud2",
                                     Direction::internal,
                                     kCloudDepth,
                                     "every capture that found something: what it saw; all so far to a new agent",
                                     false,
                                     false,
                                     &kDetectionLayout};
inline constexpr TopicInfo kMissionDurationRemained{"/{id}/mission_duration_remained",
                                                    "builtin_interfaces/msg/Duration", Direction::to_agent, kStateDepth,
                                                    "every exchange after the first take-off"};
inline constexpr TopicInfo kClock{"/clock", "rosgraph_msgs/msg/Clock", Direction::to_agent, kStateDepth,
                                  "every exchange"};
/// Eight vertices per box, box after box, in W [m].
inline constexpr TopicInfo kBoundingBoxes{
    "/gcs/bounding_box_vertices", "sensor_msgs/msg/PointCloud", Direction::to_agent, 1, "once, latched", true};
inline constexpr TopicInfo kCommandRejected{"/{id}/command_rejected", "skein_msgs/msg/CommandRejected",
                                            Direction::to_agent, kCommandDepth, "when a command is ignored"};
/// Only to a UAV that a person flies by hand.
inline constexpr TopicInfo kHand{"/{id}/hand", "skein_msgs/msg/HandCommand", Direction::to_agent, kCommandDepth,
                                 "when the viewer who flies it by hand gives another command"};
inline constexpr TopicInfo kActivity{"/{id}/activity", "skein_msgs/msg/Activity", Direction::from_agent, kCommandDepth,
                                     "from the agent, when it does something else, and each second"};
inline constexpr TopicInfo kTrajectoryCommand{"/{id}/command/trajectory", "trajectory_msgs/msg/MultiDOFJointTrajectory",
                                              Direction::from_agent, kCommandDepth,
                                              "from the agent; only points[0] is used"};
inline constexpr TopicInfo kGimbalCommand{"/{id}/command/gimbal", "geometry_msgs/msg/Twist", Direction::from_agent,
                                          kCommandDepth, "from the agent; linear.x > 0 angles, < 0 rates, 0 freeze"};
/// Two topics for the same command: the reference documents the first and reads the second.
inline constexpr TopicInfo kCameraTrigger{"/{id}/command/camera_trigger", "skein_msgs/msg/BoolStamped",
                                          Direction::from_agent, kCommandDepth, "from the agent"};
inline constexpr TopicInfo kTrigger{"/{id}/command/trigger", "skein_msgs/msg/BoolStamped", Direction::from_agent,
                                    kCommandDepth, "from the agent"};
/// Occupied and free space on this UAV's map of key frames: an OcTree in binary form. The lock-step does not count it,
/// because no program of the fleet reads it. Written only while it has readers.
inline constexpr TopicInfo kOctomap{"/{id}/octomap",
                                    "octomap_msgs/msg/Octomap",
                                    Direction::shown_by_agent,
                                    1,
                                    "when it has grown, 1 Hz at most; latched",
                                    true};
inline constexpr TopicInfo kCapture{"/skein/capture", "skein_msgs/msg/CaptureReports", Direction::internal,
                                    kCommandDepth, "server -> agent: every capture that found something better"};
inline constexpr TopicInfo kCaptureStored{"/skein/capture_ack", "skein_msgs/msg/CaptureAck", Direction::internal,
                                          kCommandDepth, "agent -> server: the station has these"};

/// All topics of a UAV's domain except those of lock-step and radio.
std::span<const TopicInfo> uav_topics();

// ---- the GCS domain --------------------------------------------------------------------------------------------

/// All points that have scored so far; channels normal_x, normal_y, normal_z, score.
inline constexpr TopicInfo kScore{"/gcs/score", "sensor_msgs/msg/PointCloud", Direction::from_station, kStateDepth,
                                  "when it changes"};
/// The same with a fifth channel, global_index: the point's index in the scene. For judges of a run, not for agents.
inline constexpr TopicInfo kScoreEval{"/score_eval", "sensor_msgs/msg/PointCloud", Direction::from_station, kStateDepth,
                                      "when it changes"};

/// The station's topics about the score. They stay in the GCS domain: radio_routes.hpp rejects radio topics with these
/// names, at either end.
std::span<const TopicInfo> score_topics();
/// All topics of the GCS domain except lock-step and radio: boxes, clock, time left, neighbours in LoS, score.
std::span<const TopicInfo> gcs_topics();

/// The station's member name in the lock-step. Its radio node is "gcs", which it may share with a user's program.
inline constexpr std::string_view kStationMember = "station";

// ---- the world domain, for viewers: RViz 2 (docs/how-to-ros2.md) --------------------------------------------------
// No program of the fleet reads these topics, and the lock-step does not count them. Written only while they have
// readers, at 10 Hz at most.

inline constexpr int kVizDepth = 8;
inline constexpr TopicInfo kVizStructure{
    "/viz/structure", "visualization_msgs/msg/Marker", Direction::to_viewer, 1, "once, latched", true};
inline constexpr TopicInfo kVizBoxes{
    "/viz/boxes", "visualization_msgs/msg/Marker", Direction::to_viewer, 1, "once, latched", true};
inline constexpr TopicInfo kVizLinks{"/viz/links", "visualization_msgs/msg/Marker", Direction::to_viewer, kVizDepth,
                                     "10 Hz; links that are open"};
inline constexpr TopicInfo kVizFrusta{"/viz/frusta", "visualization_msgs/msg/MarkerArray", Direction::to_viewer,
                                      kVizDepth, "10 Hz; what each camera looks at"};
inline constexpr TopicInfo kVizFleet{"/viz/fleet", "visualization_msgs/msg/MarkerArray", Direction::to_viewer,
                                     kVizDepth, "10 Hz; bodies and names"};
inline constexpr TopicInfo kVizPaths{"/viz/paths", "visualization_msgs/msg/MarkerArray", Direction::to_viewer,
                                     kVizDepth, "2 Hz; where each UAV was in the last 60 s"};
/// Map of all key frames so far, one point per cube of 0.5 m, in W [m].
inline constexpr TopicInfo kVizMap{"/viz/map",
                                   "sensor_msgs/msg/PointCloud2",
                                   Direction::to_viewer,
                                   1,
                                   "when it has grown, 1 Hz at most; latched",
                                   true,
                                   false,
                                   &kScanLayout};
/// Points that have scored so far, in W [m]; intensity = quality q.
inline constexpr TopicInfo kVizScored{"/viz/scored",
                                      "sensor_msgs/msg/PointCloud2",
                                      Direction::from_station,
                                      1,
                                      "when it has changed, 10 Hz at most; latched",
                                      true,
                                      false,
                                      &kScanLayout};
inline constexpr TopicInfo kTf{"/tf", "tf2_msgs/msg/TFMessage", Direction::to_viewer, kVizDepth, "10 Hz"};
inline constexpr TopicInfo kTfStatic{"/tf_static", "tf2_msgs/msg/TFMessage", Direction::to_viewer, 1, "once, latched",
                                     true};

/// All topics of this section, and the clock.
std::span<const TopicInfo> viewer_topics();

// ---- lock-step, ledger: see idl/skein_msgs.idl and docs/lockstep.md ---------------------------------------------

inline constexpr TopicInfo kStep{"/skein/step", "skein_msgs/msg/Step", Direction::internal, 8,
                                 "server -> every domain, every exchange"};
inline constexpr TopicInfo kDone{"/skein/done", "skein_msgs/msg/Done", Direction::internal, 8,
                                 "member -> its domain, every exchange"};
// The station has topics of its own for this, so that security rules can deny them to other programs in its domain
// (cli/secure/rules.cpp).
inline constexpr TopicInfo kStationDone{"/skein/station/done", "skein_msgs/msg/Done", Direction::internal, 8,
                                        "station -> GCS domain, every exchange"};
// Latched where a reader may start after the writer: a restarted process receives the last samples of all others.
inline constexpr TopicInfo kReady{"/skein/ready",
                                  "skein_msgs/msg/Ready",
                                  Direction::internal,
                                  4,
                                  "participant -> its domain, when it joins or declares anew",
                                  true};
inline constexpr TopicInfo kStationReady{"/skein/station/ready",
                                         "skein_msgs/msg/Ready",
                                         Direction::internal,
                                         4,
                                         "station -> GCS domain, when it joins or declares anew",
                                         true};
inline constexpr TopicInfo kResync{"/skein/resync",
                                   "skein_msgs/msg/Resync",
                                   Direction::internal,
                                   16,
                                   "server -> the domain of a participant that joins",
                                   true};
inline constexpr TopicInfo kAttached{"/skein/attached",
                                     "skein_msgs/msg/Attached",
                                     Direction::internal,
                                     2048,  // more than a fleet has members
                                     "router -> world, when a participant's radio topics are matched",
                                     true};
inline constexpr TopicInfo kRouted{"/skein/routed", "skein_msgs/msg/Routed", Direction::internal, 8,
                                   "router -> world, every exchange"};
inline constexpr TopicInfo kAwaits{"/skein/awaits", "skein_msgs/msg/Awaits", Direction::internal, 64,
                                   "router -> world, while it waits for a member"};
inline constexpr TopicInfo kDrop{"/skein/drop", "skein_msgs/msg/Drop", Direction::internal, 2048,
                                 "server -> world, when a member is lost"};
// Latched with a large depth, so that a station that starts late, or restarts, receives the whole ledger.
inline constexpr TopicInfo kLedger{"/skein/ledger",
                                   "skein_msgs/msg/Ledger",
                                   Direction::internal,
                                   100000,
                                   "server -> world, when the referee wrote something down",
                                   true};

// Registration of radio topics (docs/radio.md).
inline constexpr TopicInfo kRadioRequest{"/skein/radio_request", "skein_msgs/msg/RadioRequest", Direction::internal,
                                         kCommandDepth, "member -> router: opens a radio topic"};
inline constexpr TopicInfo kRadioReply{"/skein/radio_reply", "skein_msgs/msg/RadioReply", Direction::internal, 1024,
                                       "router -> member: what became of it, and when that changes"};

/// All topics of this section.
std::span<const TopicInfo> lockstep_topics();

// ---- short names: the wire topic of a node ----------------------------------------------------------------------

inline WireTopic odometry(std::string_view id) { return wire(kOdometry, id); }
inline WireTopic gimbal(std::string_view id) { return wire(kGimbal, id); }
inline WireTopic battery(std::string_view id) { return wire(kBattery, id); }
inline WireTopic wind(std::string_view id) { return wire(kWind, id); }
inline WireTopic radio_links(std::string_view id) { return wire(kRadioLinks, id); }
inline WireTopic cloud(std::string_view id) { return wire(kCloud, id); }
inline WireTopic lidar_servo(std::string_view id) { return wire(kLidarServo, id); }
inline WireTopic self_keyframe(std::string_view id) { return wire(kSelfKeyframe, id); }
inline WireTopic neighbour_keyframe(std::string_view id) { return wire(kNeighbourKeyframe, id); }
inline WireTopic neighbour_odometry(std::string_view id) { return wire(kNeighbourOdometry, id); }
inline WireTopic detected_points(std::string_view id) { return wire(kDetectedPoints, id); }
inline WireTopic detected() { return wire(kDetected); }
inline WireTopic mission_duration_remained(std::string_view id) { return wire(kMissionDurationRemained, id); }
inline WireTopic clock() { return wire(kClock); }
inline WireTopic bounding_boxes() { return wire(kBoundingBoxes); }
inline WireTopic command_rejected(std::string_view id) { return wire(kCommandRejected, id); }
inline WireTopic hand(std::string_view id) { return wire(kHand, id); }
inline WireTopic activity(std::string_view id) { return wire(kActivity, id); }
inline WireTopic trajectory_command(std::string_view id) { return wire(kTrajectoryCommand, id); }
inline WireTopic gimbal_command(std::string_view id) { return wire(kGimbalCommand, id); }
inline WireTopic camera_trigger(std::string_view id) { return wire(kCameraTrigger, id); }
/// Largest number of debug values of one UAV that sim_server reads.
inline constexpr std::size_t kMostDebugNames = 64;
/// Topic of a debug value: a number that a program publishes under a name of its choice, for faults and properties
/// (docs/properties.md). sim_server reads the topics that the program announces in its hello.
inline WireTopic debug(std::string_view id, std::string_view name) {
  return {"rt/" + std::string(id) + "/debug/" + std::string(name), wire_type("std_msgs/msg/Float64"), false,
          kCommandDepth};
}
/// The name of the debug value in a topic made by debug(id, name); empty if it is none of this UAV's, or too long.
std::string_view debug_name(std::string_view wire_topic, std::string_view id);
inline WireTopic trigger(std::string_view id) { return wire(kTrigger, id); }
inline WireTopic octomap(std::string_view id) { return wire(kOctomap, id); }
inline WireTopic capture() { return wire(kCapture); }
inline WireTopic capture_stored() { return wire(kCaptureStored); }
inline WireTopic score() { return wire(kScore); }
inline WireTopic score_eval() { return wire(kScoreEval); }
inline WireTopic viz_scored() { return wire(kVizScored); }
inline WireTopic step() { return wire(kStep); }
inline WireTopic done() { return wire(kDone); }
inline WireTopic ready() { return wire(kReady); }
inline WireTopic station_done() { return wire(kStationDone); }
inline WireTopic station_ready() { return wire(kStationReady); }
inline WireTopic attached() { return wire(kAttached); }
inline WireTopic routed() { return wire(kRouted); }
inline WireTopic awaits() { return wire(kAwaits); }
inline WireTopic drop() { return wire(kDrop); }
inline WireTopic resync() { return wire(kResync); }
inline WireTopic ledger() { return wire(kLedger); }
inline WireTopic radio_request() { return wire(kRadioRequest); }
inline WireTopic radio_reply() { return wire(kRadioReply); }

}  // namespace topics
}  // namespace skein
