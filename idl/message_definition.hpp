// The ROS 2 message definition of a type of the IDL. A recording contains this text, so that any tool can read its
// messages without knowing Skein. Made from the IDL files, which are compiled in. Any thread.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace skein {

/// A type as ROS 2 describes it in a recording (encoding "ros2msg").
struct MessageDefinition {
  std::string name;  ///< "nav_msgs/msg/Odometry"
  /// Fields, a line each; then the same of each type that it is made of, behind a line of 80 '=' and "MSG: NAME".
  std::string text;
};

/// @param wire_type  "nav_msgs::msg::dds_::Odometry_".
/// @throws std::out_of_range when it is not in the IDL.
const MessageDefinition& message_definition(const std::string& wire_type);

/// All structs of an IDL file: name on the wire to fields, as "package/Type name" or "float64[36] name" lines.
/// It knows what the IDL files here use: modules, final structs, comments, basic types, strings, arrays, sequences.
/// @throws std::invalid_argument with the line for anything else.
std::map<std::string, std::string> ros_fields(std::string_view idl);

}  // namespace skein
