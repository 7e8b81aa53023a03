// The one table of all message types: C++ type, short name, name on the wire (ROS 2's own).
//   skein::msg::Odometry is nav_msgs::msg::dds_::Odometry_, and type_name<msg::Odometry>() returns that name.
// A new type in an .idl file gets a line here.
#pragma once

#include <string>

#include "idl/builtin_interfaces.h"
#include "idl/geometry_msgs.h"
#include "idl/nav_msgs.h"
#include "idl/octomap_msgs.h"
#include "idl/rosgraph_msgs.h"
#include "idl/sensor_msgs.h"
#include "idl/skein_msgs.h"
#include "idl/std_msgs.h"
#include "idl/tf2_msgs.h"
#include "idl/trajectory_msgs.h"
#include "idl/visualization_msgs.h"

namespace skein {

/// Specialised below; a type that is not in the table does not compile.
template <class T>
struct TypeName;

/// Name on the wire, e.g. "nav_msgs::msg::dds_::Odometry_".
template <class T>
std::string type_name() {
  return TypeName<T>::kValue;
}

}  // namespace skein

/// All types, as X(package, Name): for this table, and for tests that go through every type.
#define SKEIN_ALL_TYPES(X)                         \
  X(builtin_interfaces, Time)                      \
  X(builtin_interfaces, Duration)                  \
  X(std_msgs, Header)                              \
  X(std_msgs, String)                              \
  X(std_msgs, Float64)                             \
  X(std_msgs, ColorRGBA)                           \
  X(rosgraph_msgs, Clock)                          \
  X(geometry_msgs, Vector3)                        \
  X(geometry_msgs, Point)                          \
  X(geometry_msgs, Point32)                        \
  X(geometry_msgs, Quaternion)                     \
  X(geometry_msgs, Pose)                           \
  X(geometry_msgs, PoseStamped)                    \
  X(geometry_msgs, PoseWithCovariance)             \
  X(geometry_msgs, Twist)                          \
  X(geometry_msgs, TwistStamped)                   \
  X(geometry_msgs, TwistWithCovariance)            \
  X(geometry_msgs, Transform)                      \
  X(geometry_msgs, TransformStamped)               \
  X(nav_msgs, Odometry)                            \
  X(nav_msgs, Path)                                \
  X(octomap_msgs, Octomap)                         \
  X(sensor_msgs, PointField)                       \
  X(sensor_msgs, PointCloud2)                      \
  X(sensor_msgs, BatteryState)                     \
  X(sensor_msgs, CompressedImage)                  \
  X(sensor_msgs, JointState)                       \
  X(sensor_msgs, ChannelFloat32)                   \
  X(sensor_msgs, PointCloud)                       \
  X(tf2_msgs, TFMessage)                           \
  X(trajectory_msgs, MultiDOFJointTrajectory)      \
  X(trajectory_msgs, MultiDOFJointTrajectoryPoint) \
  X(visualization_msgs, UVCoordinate)              \
  X(visualization_msgs, MeshFile)                  \
  X(visualization_msgs, Marker)                    \
  X(visualization_msgs, MarkerArray)               \
  X(skein_msgs, TopicCount)                        \
  X(skein_msgs, Member)                            \
  X(skein_msgs, Order)                             \
  X(skein_msgs, FaultBegin)                        \
  X(skein_msgs, Step)                              \
  X(skein_msgs, Done)                              \
  X(skein_msgs, NodeCounts)                        \
  X(skein_msgs, Routed)                            \
  X(skein_msgs, Await)                             \
  X(skein_msgs, Awaits)                            \
  X(skein_msgs, Drop)                              \
  X(skein_msgs, Ready)                             \
  X(skein_msgs, Attached)                          \
  X(skein_msgs, Resync)                            \
  X(skein_msgs, RadioRequest)                      \
  X(skein_msgs, RadioReply)                        \
  X(skein_msgs, BoolStamped)                       \
  X(skein_msgs, CommandRejected)                   \
  X(skein_msgs, RadioLink)                         \
  X(skein_msgs, RadioLinks)                        \
  X(skein_msgs, Activity)                          \
  X(skein_msgs, HandCommand)                       \
  X(skein_msgs, Event)                             \
  X(skein_msgs, Tally)                             \
  X(skein_msgs, Arrival)                           \
  X(skein_msgs, Arrivals)                          \
  X(skein_msgs, CapturePoint)                      \
  X(skein_msgs, CaptureReport)                     \
  X(skein_msgs, CaptureReports)                    \
  X(skein_msgs, CaptureAck)                        \
  X(skein_msgs, LedgerEntry)                       \
  X(skein_msgs, InterestPoint)                     \
  X(skein_msgs, Ledger)

#define SKEIN_DEFINE_TYPE(package, name)                                      \
  namespace skein::msg {                                                      \
  using name = ::package::msg::dds_::name##_;                                 \
  }                                                                           \
  template <>                                                                 \
  struct skein::TypeName<::package::msg::dds_::name##_> {                     \
    static constexpr const char* kValue = #package "::msg::dds_::" #name "_"; \
  };
SKEIN_ALL_TYPES(SKEIN_DEFINE_TYPE)
#undef SKEIN_DEFINE_TYPE
