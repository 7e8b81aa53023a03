#include "idl/message_definition.hpp"

#include <gtest/gtest.h>

#include <regex>
#include <sstream>
#include <stdexcept>

#include "idl/type_names.hpp"

namespace skein {
namespace {

TEST(MessageDefinition, EqualsThatOfRos2) {
  const MessageDefinition& definition = message_definition(type_name<msg::TwistStamped>());
  const std::string line = std::string(80, '=') + "\n";
  EXPECT_EQ(definition.name, "geometry_msgs/msg/TwistStamped");
  EXPECT_EQ(definition.text,
            "std_msgs/Header header\ngeometry_msgs/Twist twist\n" + line +
                "MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n" + line +
                "MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n" + line +
                "MSG: geometry_msgs/Twist\ngeometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n" + line +
                "MSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n");
}

TEST(MessageDefinition, KnowsArraysSequencesAndLongNumbers) {
  EXPECT_NE(message_definition(type_name<msg::PoseWithCovariance>()).text.find("float64[36] covariance\n"),
            std::string::npos);
  const std::string cloud = message_definition(type_name<msg::PointCloud2>()).text;
  EXPECT_NE(cloud.find("sensor_msgs/PointField[] fields\n"), std::string::npos);
  EXPECT_NE(cloud.find("uint8[] data\n"), std::string::npos);
  EXPECT_NE(message_definition(type_name<msg::Step>()).text.find("uint64 run\n"), std::string::npos);
}

TEST(MessageDefinition, DescribesEachContainedTypeExactlyOnce) {
  const auto check = [](const std::string& wire_type) {
    const MessageDefinition& definition = message_definition(wire_type);
    EXPECT_TRUE(std::regex_match(definition.name, std::regex(R"(\w+/msg/\w+)"))) << definition.name;
    std::istringstream lines(definition.text);
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("=") || line.starts_with("MSG: ")) continue;
      const std::string type = line.substr(0, line.find_first_of(" ["));
      if (type.find('/') == std::string::npos) continue;
      const std::string head = "MSG: " + type + "\n";
      const std::size_t at = definition.text.find(head);
      ASSERT_NE(at, std::string::npos) << definition.name << " lacks " << type;
      EXPECT_EQ(definition.text.find(head, at + 1), std::string::npos) << definition.name << " has twice " << type;
    }
  };
#define SKEIN_CHECK_TYPE(package, name) check(type_name<msg::name>());
  SKEIN_ALL_TYPES(SKEIN_CHECK_TYPE)
#undef SKEIN_CHECK_TYPE
  EXPECT_THROW(message_definition("std_msgs::msg::dds_::Nothing_"), std::out_of_range);
}

TEST(MessageDefinition, AnUnsupportedConstructOfTheIdlIsAnError) {
  const auto in_struct = [](const std::string& member) {
    return "module a { module msg { module dds_ {\n@final struct T_ {\n  " + member + "\n};\n}; }; };\n";
  };
  EXPECT_EQ(ros_fields(in_struct("b::msg::dds_::U_ u; // why")).at("a::msg::dds_::T_"), "b/U u\n");
  for (const char* odd :
       {"map<long, long> m;", "wchar w;", "sequence<sequence<octet>> s;", "long a, b;", "enum E {X};"}) {
    EXPECT_THROW(ros_fields(in_struct(odd)), std::invalid_argument) << odd;
  }
}

}  // namespace
}  // namespace skein
