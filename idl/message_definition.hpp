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
  /// The fields, one per line; then, for each contained type, a line of 80 '=', a line "MSG: NAME", and its fields.
  std::string text;
};

/// @param wire_type  "nav_msgs::msg::dds_::Odometry_".
/// @throws std::out_of_range if the type is not in the IDL.
const MessageDefinition& message_definition(const std::string& wire_type);

/// The fields of each struct of an IDL file, by the struct's name on the wire: lines such as "package/Type name" or
/// "float64[36] name". This parser knows only the part of IDL that Skein's files use: modules, final structs, comments,
/// basic types, strings, arrays, sequences. @throws std::invalid_argument, with the line, for anything else.
std::map<std::string, std::string> ros_fields(std::string_view idl);

}  // namespace skein
