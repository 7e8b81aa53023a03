#include "idl/conversions.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace skein {
namespace {

constexpr std::int64_t kNsPerTick = 2'500'000;
constexpr std::int64_t kNsPerSecond = 1'000'000'000;
constexpr const char* kLidarServoJoint = "lidar_servo";

void set_xyz(auto& message, const Vector3d& v) {
  message.x(v.x());
  message.y(v.y());
  message.z(v.z());
}

void set_quaternion(msg::Quaternion& message, const Quaterniond& q) {
  message.x(q.x());
  message.y(q.y());
  message.z(q.z());
  message.w(q.w());
}

Vector3d xyz(const auto& message) { return {message.x(), message.y(), message.z()}; }

template <class Point>
const topics::CloudLayout& layout_of();
template <>
const topics::CloudLayout& layout_of<ScanPoint>() {
  return topics::kScanLayout;
}
template <>
const topics::CloudLayout& layout_of<NeighbourPoint>() {
  return topics::kNeighbourLayout;
}
template <>
const topics::CloudLayout& layout_of<DetectionPoint>() {
  return topics::kDetectionLayout;
}

static_assert(sizeof(ScanPoint) == topics::kScanLayout.point_step);
static_assert(sizeof(NeighbourPoint) == topics::kNeighbourLayout.point_step);
static_assert(sizeof(DetectionPoint) == topics::kDetectionLayout.point_step);

template <class Point>
msg::PointCloud2 make_cloud(Tick tick, std::size_t size) {
  const topics::CloudLayout& layout = layout_of<Point>();
  msg::PointCloud2 cloud;
  cloud.header(to_header(tick));
  cloud.height(1);
  cloud.width(static_cast<std::uint32_t>(size));
  for (const topics::CloudField& field : layout.fields) {
    msg::PointField f;
    f.name(std::string(field.name));
    f.offset(field.offset);
    f.datatype(static_cast<std::uint8_t>(field.type));
    f.count(1);
    cloud.fields().push_back(f);
  }
  cloud.is_bigendian(false);
  cloud.point_step(layout.point_step);
  cloud.row_step(static_cast<std::uint32_t>(layout.point_step * size));
  cloud.data().resize(layout.point_step * size);
  cloud.is_dense(true);
  return cloud;
}

template <class Point>
msg::PointCloud2 pack(Tick tick, std::span<const Point> points) {
  msg::PointCloud2 cloud = make_cloud<Point>(tick, points.size());
  if (!points.empty()) std::memcpy(cloud.data().data(), points.data(), points.size_bytes());
  return cloud;
}

}  // namespace

msg::Time to_time(Tick tick) {
  const std::int64_t ns = tick * kNsPerTick;
  msg::Time time;
  time.sec(static_cast<std::int32_t>(ns / kNsPerSecond));
  time.nanosec(static_cast<std::uint32_t>(ns % kNsPerSecond));
  return time;
}

Tick from_time(const msg::Time& time) { return time.sec() * kTicksPerSecond + ticks(time.nanosec() * 1e-9); }

msg::Header to_header(Tick tick, const std::string& frame) {
  msg::Header header;
  header.stamp(to_time(tick));
  header.frame_id(frame);
  return header;
}

msg::Duration to_duration(double seconds) {
  const auto ns = static_cast<std::int64_t>(std::llround(seconds * 1e9));
  msg::Duration duration;
  duration.sec(static_cast<std::int32_t>(ns / kNsPerSecond));
  duration.nanosec(static_cast<std::uint32_t>(ns % kNsPerSecond));
  return duration;
}

double from_duration(const msg::Duration& duration) { return duration.sec() + duration.nanosec() * 1e-9; }

msg::Point to_point(const Vector3d& p) {
  msg::Point point;
  set_xyz(point, p);
  return point;
}

msg::Pose to_pose(const Vector3d& p, const Quaterniond& q) {
  msg::Pose pose;
  set_xyz(pose.position(), p);
  set_quaternion(pose.orientation(), q);
  return pose;
}

msg::Transform to_transform(const Isometry3d& X) {
  msg::Transform transform;
  set_xyz(transform.translation(), X.translation());
  set_quaternion(transform.rotation(), Quaterniond(X.linear()));
  return transform;
}

msg::Odometry to_odometry(Tick tick, const std::string& id, const RigidBodyState& state,
                          const PoseUncertainty& uncertainty) {
  msg::Odometry odometry;
  odometry.header(to_header(tick));
  odometry.child_frame_id(id + "/base_link");
  odometry.pose().pose(to_pose(state.p_WB, state.q_WB));
  set_xyz(odometry.twist().twist().linear(), state.q_WB.conjugate() * state.v_WB);
  set_xyz(odometry.twist().twist().angular(), state.w_WB_B);
  add_uncertainty(uncertainty, odometry);
  return odometry;
}

RigidBodyState from_odometry(const msg::Odometry& odometry) {
  RigidBodyState state;
  const auto& pose = odometry.pose().pose();
  const auto& q = pose.orientation();
  state.p_WB = xyz(pose.position());
  state.q_WB = Quaterniond(q.w(), q.x(), q.y(), q.z());
  state.v_WB = state.q_WB * xyz(odometry.twist().twist().linear());
  state.w_WB_B = xyz(odometry.twist().twist().angular());
  return state;
}

msg::TwistStamped to_gimbal(Tick tick, const std::string& id, const GimbalState& gimbal) {
  msg::TwistStamped twist;
  twist.header(to_header(tick, id + "/gimbal"));
  set_xyz(twist.twist().linear(), {0.0, gimbal.pitch, gimbal.yaw});
  set_xyz(twist.twist().angular(), {0.0, gimbal.pitch_rate, gimbal.yaw_rate});
  return twist;
}

GimbalState from_gimbal(const msg::TwistStamped& twist) {
  return {twist.twist().linear().y(), twist.twist().linear().z(), twist.twist().angular().y(),
          twist.twist().angular().z()};
}

msg::JointState to_lidar_servo(const LidarServo& servo) {
  msg::JointState joints;
  joints.header(to_header(servo.tick, ""));  // an angle belongs to no frame
  joints.name().emplace_back(kLidarServoJoint);
  joints.position().push_back(servo.angle);
  joints.velocity().push_back(servo.rate);
  return joints;
}

std::optional<LidarServo> from_lidar_servo(const msg::JointState& joints) {
  const auto& names = joints.name();
  const auto joint = static_cast<std::size_t>(std::ranges::find(names, kLidarServoJoint) - names.begin());
  if (joint >= names.size() || joint >= joints.position().size() || joint >= joints.velocity().size()) return {};
  const LidarServo servo{from_time(joints.header().stamp()), joints.position()[joint], joints.velocity()[joint]};
  if (!std::isfinite(servo.angle) || !std::isfinite(servo.rate)) return {};
  return servo;
}

msg::MultiDOFJointTrajectory to_trajectory(Tick tick, const TrajectoryCommand& command) {
  msg::Transform transform;
  set_xyz(transform.translation(), command.p_WB);
  transform.rotation().z(std::sin(0.5 * command.yaw));
  transform.rotation().w(std::cos(0.5 * command.yaw));
  msg::Twist velocity, acceleration;
  set_xyz(velocity.linear(), command.v_WB);
  velocity.angular().z(command.yaw_rate);
  set_xyz(acceleration.linear(), command.a_WB);
  msg::MultiDOFJointTrajectoryPoint point;
  point.transforms().push_back(transform);
  point.velocities().push_back(velocity);
  point.accelerations().push_back(acceleration);
  msg::MultiDOFJointTrajectory trajectory;
  trajectory.header(to_header(tick));
  trajectory.points().push_back(point);
  return trajectory;
}

std::optional<TrajectoryCommand> from_trajectory(const msg::MultiDOFJointTrajectory& trajectory) {
  if (trajectory.points().empty() || trajectory.points()[0].transforms().empty()) return std::nullopt;
  const auto& point = trajectory.points()[0];
  const auto& q = point.transforms()[0].rotation();
  TrajectoryCommand command;
  command.p_WB = xyz(point.transforms()[0].translation());
  if (!point.velocities().empty()) {
    command.v_WB = xyz(point.velocities()[0].linear());
    command.yaw_rate = point.velocities()[0].angular().z();
  }
  if (!point.accelerations().empty()) command.a_WB = xyz(point.accelerations()[0].linear());
  command.yaw = std::atan2(2.0 * (q.w() * q.z() + q.x() * q.y()), 1.0 - 2.0 * (q.y() * q.y() + q.z() * q.z()));
  return command;
}

msg::Twist to_gimbal_command(const GimbalCommand& command) {
  msg::Twist twist;
  switch (command.mode) {
    case GimbalMode::angle:
      set_xyz(twist.linear(), {1.0, command.pitch, command.yaw});
      break;
    case GimbalMode::rate:
      twist.linear().x(-1.0);
      set_xyz(twist.angular(), {0.0, command.pitch, command.yaw});
      break;
    case GimbalMode::freeze:
      break;
  }
  return twist;
}

GimbalCommand from_gimbal_command(const msg::Twist& twist) {
  // Quirk G6: values in [-1e-7, 0] freeze.
  if (twist.linear().x() > 0.0) return {GimbalMode::angle, twist.linear().y(), twist.linear().z()};
  if (twist.linear().x() < -1e-7) return {GimbalMode::rate, twist.angular().y(), twist.angular().z()};
  return {GimbalMode::freeze, 0.0, 0.0};
}

msg::PointCloud to_box_vertices(Tick tick, std::span<const OrientedBox> boxes) {
  msg::PointCloud cloud;
  cloud.header(to_header(tick));
  for (const OrientedBox& box : boxes) {
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3d sign((corner & 1) ? 0.5 : -0.5, (corner & 2) ? 0.5 : -0.5, (corner & 4) ? 0.5 : -0.5);
      const Eigen::Vector3f p = (box.center + box.R_WO * box.size.cwiseProduct(sign)).cast<float>();
      msg::Point32 point;
      point.x(p.x());
      point.y(p.y());
      point.z(p.z());
      cloud.points().push_back(point);
    }
  }
  return cloud;
}

std::vector<OrientedBox> from_box_vertices(const msg::PointCloud& cloud) {
  std::vector<OrientedBox> boxes;
  for (std::size_t i = 0; i + 8 <= cloud.points().size(); i += 8) {
    const auto corner = [&](std::size_t c) { return xyz(cloud.points()[i + c]); };
    const Vector3d p0 = corner(0), p7 = corner(7);
    const Vector3d edges[3] = {corner(1) - p0, corner(2) - p0, corner(4) - p0};
    OrientedBox box;
    box.name = "box" + std::to_string(boxes.size() + 1);
    box.center = 0.5 * (p0 + p7);
    for (int axis = 0; axis < 3; ++axis) box.size[axis] = edges[axis].norm();
    if (box.size.minCoeff() > 0.0) {
      // The vertices are in single precision, so the edges are not exactly at right angles: correct the axes.
      const Vector3d x = edges[0].normalized();
      const Vector3d y = (edges[1] - x * x.dot(edges[1])).normalized();
      Vector3d z = x.cross(y);
      if (z.dot(edges[2]) < 0.0) z = -z;
      box.R_WO << x, y, z;
    }
    boxes.push_back(std::move(box));
  }
  return boxes;
}

msg::PointCloud2 to_cloud(Tick tick, std::span<const ScanPoint> points) { return pack(tick, points); }
msg::PointCloud2 to_cloud(Tick tick, std::span<const NeighbourPoint> points) { return pack(tick, points); }
msg::PointCloud2 to_cloud(Tick tick, std::span<const DetectionPoint> points) { return pack(tick, points); }

msg::PointCloud2 to_cloud(Tick tick, std::span<const Eigen::Vector3f> points, float intensity) {
  msg::PointCloud2 cloud = make_cloud<ScanPoint>(tick, points.size());
  std::uint8_t* out = cloud.data().data();
  for (const Eigen::Vector3f& p : points) {
    const ScanPoint point{p.x(), p.y(), p.z(), intensity};
    std::memcpy(out, &point, sizeof point);
    out += sizeof point;
  }
  return cloud;
}

msg::PointCloud to_score_cloud(Tick tick, std::span<const ScoredPoint> points, bool with_indices) {
  msg::PointCloud cloud;
  cloud.header(to_header(tick));
  const auto add_channel = [&](const char* name, auto&& value_of) {
    msg::ChannelFloat32 channel;
    channel.name(name);
    for (const ScoredPoint& p : points) channel.values().push_back(static_cast<float>(value_of(p)));
    cloud.channels().push_back(std::move(channel));
  };
  for (const ScoredPoint& p : points) {
    msg::Point32 point;
    point.x(p.point.p_W.x());
    point.y(p.point.p_W.y());
    point.z(p.point.p_W.z());
    cloud.points().push_back(point);
  }
  add_channel("normal_x", [](const ScoredPoint& p) { return p.point.n_W.x(); });
  add_channel("normal_y", [](const ScoredPoint& p) { return p.point.n_W.y(); });
  add_channel("normal_z", [](const ScoredPoint& p) { return p.point.n_W.z(); });
  add_channel("score", [](const ScoredPoint& p) { return p.score; });
  if (with_indices) add_channel("global_index", [](const ScoredPoint& p) { return p.index; });
  return cloud;
}

template <class Point>
std::vector<Point> from_cloud(const msg::PointCloud2& cloud) {
  const topics::CloudLayout& layout = layout_of<Point>();
  const auto& fields = cloud.fields();
  const bool same = !cloud.is_bigendian() && cloud.point_step() == layout.point_step &&
                    std::equal(fields.begin(), fields.end(), layout.fields.begin(), layout.fields.end(),
                               [](const msg::PointField& a, const topics::CloudField& b) {
                                 return a.name() == b.name && a.offset() == b.offset &&
                                        a.datatype() == static_cast<std::uint8_t>(b.type);
                               });
  if (!same) return {};
  std::vector<Point> points(cloud.data().size() / sizeof(Point));
  if (!points.empty()) std::memcpy(points.data(), cloud.data().data(), points.size() * sizeof(Point));
  return points;
}

template std::vector<ScanPoint> from_cloud(const msg::PointCloud2&);
template std::vector<NeighbourPoint> from_cloud(const msg::PointCloud2&);
template std::vector<DetectionPoint> from_cloud(const msg::PointCloud2&);

std::optional<std::uint32_t> whole_number(float value) {
  if (!(value >= 0.0F) || !(value < 4294967296.0F) || std::trunc(value) != value) return std::nullopt;
  return static_cast<std::uint32_t>(value);
}

}  // namespace skein
