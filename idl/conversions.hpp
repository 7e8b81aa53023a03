// Between Skein's own types and the messages on the wire, CARIC's conventions included. Used at the edge of each
// program only. Frames W and B; SI units and radians. Pure; safe from any thread.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/messages/uav_status.hpp"
#include "core/scoring/score_table.hpp"
#include "core/topics.hpp"
#include "core/types.hpp"
#include "idl/type_names.hpp"

namespace skein {

msg::Time to_time(Tick tick);
/// The nearest tick.
Tick from_time(const msg::Time& time);
msg::Header to_header(Tick tick, const std::string& frame = "world");
/// @param seconds  not negative.
msg::Duration to_duration(double seconds);
double from_duration(const msg::Duration& duration);

msg::Point to_point(const Vector3d& p);
msg::Pose to_pose(const Vector3d& p, const Quaterniond& q);
msg::Transform to_transform(const Isometry3d& X);

/// Twist in the body frame, as CARIC has it. The covariances are diagonal: an exact odometry has none.
msg::Odometry to_odometry(Tick tick, const std::string& id, const RigidBodyState& state,
                          const PoseUncertainty& uncertainty = {});
/// Velocity back in W.
RigidBodyState from_odometry(const msg::Odometry& odometry);
void add_uncertainty(const PoseUncertainty& uncertainty, msg::Odometry& odometry);
/// The errors that the odometry states; a negative or infinite variance counts as none.
PoseUncertainty uncertainty_from_odometry(const msg::Odometry& odometry);

msg::BatteryState to_battery(Tick tick, const BatteryStatus& battery, int cells);
/// nullopt where a number is not finite.
std::optional<BatteryStatus> from_battery(const msg::BatteryState& battery);

/// Velocity of the air, in W.
msg::TwistStamped to_wind(Tick tick, const Vector3d& wind_W);
/// nullopt where a number is not finite.
std::optional<Vector3d> from_wind(const msg::TwistStamped& wind);

/// The message about the open links of a UAV.
msg::RadioLinks to_radio_links(Tick tick, const LinkQualities& links);
/// Leaves out links with a number that is not finite.
LinkQualities from_radio_links(const msg::RadioLinks& links);

/// Angles in linear, rates in angular; y pitch, z yaw.
msg::TwistStamped to_gimbal(Tick tick, const std::string& id, const GimbalState& gimbal);
GimbalState from_gimbal(const msg::TwistStamped& twist);

/// One joint, "lidar_servo", with position and velocity.
msg::JointState to_lidar_servo(const LidarServo& servo);
/// nullopt without a joint of that name, or where its position or velocity is missing or no finite number.
std::optional<LidarServo> from_lidar_servo(const msg::JointState& joints);

msg::MultiDOFJointTrajectory to_trajectory(Tick tick, const TrajectoryCommand& command);
/// Only points[0] counts; missing parts are zero. @returns nullopt without a point that has a transform.
std::optional<TrajectoryCommand> from_trajectory(const msg::MultiDOFJointTrajectory& trajectory);

/// linear.x > 0 angles (linear y pitch, z yaw), < 0 rates (angular y, z), 0 freeze.
msg::Twist to_gimbal_command(const GimbalCommand& command);
GimbalCommand from_gimbal_command(const msg::Twist& twist);

/// Eight vertices a box, box after box; the first is the corner at -x -y -z of the box's own axes, then x fastest.
msg::PointCloud to_box_vertices(Tick tick, std::span<const OrientedBox> boxes);
/// Boxes from such vertices, names box1, box2, ... (single precision). Groups of fewer than eight are left out.
std::vector<OrientedBox> from_box_vertices(const msg::PointCloud& cloud);

// ---- point clouds; the structs are the layouts of core/topics.hpp ------------------------------------------------

struct ScanPoint {
  float x = 0, y = 0, z = 0, intensity = 0;
};
struct NeighbourPoint {
  float x = 0, y = 0, z = 0;
  float node = 0;  ///< on the wire "intensity"
  double t = 0;
  float qx = 0, qy = 0, qz = 0, qw = 1;
  float vx = 0, vy = 0, vz = 0;
  float wx = 0, wy = 0, wz = 0;
};
struct DetectionPoint {
  float x = 0, y = 0, z = 0;
  float score = 0;  ///< on the wire "intensity"
  float normal_x = 0, normal_y = 0, normal_z = 0;
  float order = 0;  ///< of detection; on the wire "curvature"
};

msg::PointCloud2 to_cloud(Tick tick, std::span<const ScanPoint> points);
/// A scan whose points all have one intensity: a neighbour's key frame carries its node number there.
msg::PointCloud2 to_cloud(Tick tick, std::span<const Eigen::Vector3f> points, float intensity = 0.0F);
msg::PointCloud2 to_cloud(Tick tick, std::span<const NeighbourPoint> points);
msg::PointCloud2 to_cloud(Tick tick, std::span<const DetectionPoint> points);
/// A point that scores, as the station tells of it.
struct ScoredPoint {
  InterestPoint point;
  float score = 0.0F;
  std::uint32_t index = 0;  ///< in the scene
};

/// Channels normal_x, normal_y, normal_z, score, and, where they are asked for, global_index.
msg::PointCloud to_score_cloud(Tick tick, std::span<const ScoredPoint> points, bool with_indices);

/// Empty when the cloud's layout is not that of Point.
template <class Point>
std::vector<Point> from_cloud(const msg::PointCloud2& cloud);
extern template std::vector<ScanPoint> from_cloud(const msg::PointCloud2&);
extern template std::vector<NeighbourPoint> from_cloud(const msg::PointCloud2&);
extern template std::vector<DetectionPoint> from_cloud(const msg::PointCloud2&);

/// A number that counts or names something and travels as a float. nullopt when it is none: a fraction, below zero, not
/// finite, or beyond 32 bits.
std::optional<std::uint32_t> whole_number(float value);

// ---- custody ----------------------------------------------------------------------------------------------------

/// Where an interest point is, as the first message of the ledger tells the station.
msg::InterestPoint to_message(const InterestPoint& point);
InterestPoint from_message(const msg::InterestPoint& point);

/// @param fleet  names in fleet order.
msg::CaptureReport to_message(const CaptureReport& report, std::span<const std::string> fleet);
/// nullopt when the UAV is not of the fleet.
std::optional<CaptureReport> from_message(const msg::CaptureReport& report, std::span<const std::string> fleet);
/// The captures of one UAV that the station has, with a checksum by which the receiver detects damage.
msg::CaptureAck to_capture_ack(const std::string& uav, std::vector<std::uint64_t> captures);
/// Empty when the sum is not that of the content, or the message is for another UAV: radio links may flip bits, and a
/// wrong number would erase another capture.
std::vector<std::uint64_t> from_capture_ack(const msg::CaptureAck& ack, const std::string& uav);

msg::LedgerEntry to_message(const LedgerEntry& entry, std::span<const std::string> fleet);
std::optional<LedgerEntry> from_message(const msg::LedgerEntry& entry, std::span<const std::string> fleet);

}  // namespace skein
