// Converts Skein's own types to the messages on the wire, with CARIC's conventions, and back. Programs call this only
// where they send and receive. Frames W and B; SI units and radians. Pure; safe from any thread.
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

/// The twist is in the body frame, as in CARIC. The covariances are diagonal; those of an exact odometry are zero.
msg::Odometry to_odometry(Tick tick, const std::string& id, const RigidBodyState& state,
                          const PoseUncertainty& uncertainty = {});
/// Converts the velocity back to W.
RigidBodyState from_odometry(const msg::Odometry& odometry);
void add_uncertainty(const PoseUncertainty& uncertainty, msg::Odometry& odometry);
/// The standard deviations that the odometry states; a variance that is negative or not finite counts as 0.
PoseUncertainty uncertainty_from_odometry(const msg::Odometry& odometry);

msg::BatteryState to_battery(Tick tick, const BatteryStatus& battery, int cells);
/// nullopt if a number is not finite.
std::optional<BatteryStatus> from_battery(const msg::BatteryState& battery);

/// Velocity of the air, in W.
msg::TwistStamped to_wind(Tick tick, const Vector3d& wind_W);
/// nullopt if a number is not finite.
std::optional<Vector3d> from_wind(const msg::TwistStamped& wind);

/// The message about the open links of a UAV.
msg::RadioLinks to_radio_links(Tick tick, const LinkQualities& links);
/// Leaves out links with a number that is not finite.
LinkQualities from_radio_links(const msg::RadioLinks& links);

/// `linear` has the angles, `angular` the rates: y is pitch, z is yaw.
msg::TwistStamped to_gimbal(Tick tick, const std::string& id, const GimbalState& gimbal);
GimbalState from_gimbal(const msg::TwistStamped& twist);

/// One joint, "lidar_servo", with position and velocity.
msg::JointState to_lidar_servo(const LidarServo& servo);
/// nullopt if there is no joint of that name, or its position or velocity is missing or not finite.
std::optional<LidarServo> from_lidar_servo(const msg::JointState& joints);

msg::MultiDOFJointTrajectory to_trajectory(Tick tick, const TrajectoryCommand& command);
/// Reads only points[0]; its missing parts count as zero. @returns nullopt if it does not exist or has no transform.
std::optional<TrajectoryCommand> from_trajectory(const msg::MultiDOFJointTrajectory& trajectory);

/// linear.x selects the mode: > 0 angles (linear.y pitch, linear.z yaw), < 0 rates (angular.y, angular.z), 0 freeze.
msg::Twist to_gimbal_command(const GimbalCommand& command);
GimbalCommand from_gimbal_command(const msg::Twist& twist);

/// Eight vertices per box, box after box. The first is the corner at -x -y -z of the box's own axes; x changes fastest.
msg::PointCloud to_box_vertices(Tick tick, std::span<const OrientedBox> boxes);
/// The boxes of such vertices, named box1, box2, ... (single precision). Ignores an incomplete group at the end.
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
/// A scan whose points all have the same intensity: in a neighbour's key frame it is the neighbour's node number.
msg::PointCloud2 to_cloud(Tick tick, std::span<const Eigen::Vector3f> points, float intensity = 0.0F);
msg::PointCloud2 to_cloud(Tick tick, std::span<const NeighbourPoint> points);
msg::PointCloud2 to_cloud(Tick tick, std::span<const DetectionPoint> points);
/// An interest point with its score, as the station publishes it.
struct ScoredPoint {
  InterestPoint point;
  float score = 0.0F;
  std::uint32_t index = 0;  ///< in the scene
};

/// The cloud has the channels normal_x, normal_y, normal_z and score; if `with_indices`, also global_index.
msg::PointCloud to_score_cloud(Tick tick, std::span<const ScoredPoint> points, bool with_indices);

/// Empty if the cloud's layout is not that of Point.
template <class Point>
std::vector<Point> from_cloud(const msg::PointCloud2& cloud);
extern template std::vector<ScanPoint> from_cloud(const msg::PointCloud2&);
extern template std::vector<NeighbourPoint> from_cloud(const msg::PointCloud2&);
extern template std::vector<DetectionPoint> from_cloud(const msg::PointCloud2&);

/// Reads an index or a count that was sent as a float. nullopt if it is not a whole number from 0 to 2^32 - 1.
std::optional<std::uint32_t> whole_number(float value);

// ---- custody ----------------------------------------------------------------------------------------------------

/// An interest point of the scene, as in the first message of the ledger.
msg::InterestPoint to_message(const InterestPoint& point);
InterestPoint from_message(const msg::InterestPoint& point);

/// @param fleet  names in fleet order.
msg::CaptureReport to_message(const CaptureReport& report, std::span<const std::string> fleet);
/// nullopt if the UAV does not belong to the fleet.
std::optional<CaptureReport> from_message(const msg::CaptureReport& report, std::span<const std::string> fleet);
/// The captures of one UAV that the station has, with a checksum by which the receiver detects damage.
msg::CaptureAck to_capture_ack(const std::string& uav, std::vector<std::uint64_t> captures);
/// Empty if the checksum does not match, or the message is for another UAV: radio links may flip bits, and a wrong
/// number would make the UAV delete the report of another capture.
std::vector<std::uint64_t> from_capture_ack(const msg::CaptureAck& ack, const std::string& uav);

msg::LedgerEntry to_message(const LedgerEntry& entry, std::span<const std::string> fleet);
std::optional<LedgerEntry> from_message(const msg::LedgerEntry& entry, std::span<const std::string> fleet);

}  // namespace skein
