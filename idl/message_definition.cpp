#include "idl/message_definition.hpp"

#include <algorithm>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "idl/idl_files.hpp"

namespace skein {
namespace {

const std::map<std::string, std::string>& basic_types() {
  static const std::map<std::string, std::string> kTypes = {{"boolean", "bool"},
                                                            {"octet", "uint8"},
                                                            {"int8", "int8"},
                                                            {"char", "char"},
                                                            {"short", "int16"},
                                                            {"long", "int32"},
                                                            {"long long", "int64"},
                                                            {"unsigned short", "uint16"},
                                                            {"unsigned long", "uint32"},
                                                            {"unsigned long long", "uint64"},
                                                            {"float", "float32"},
                                                            {"double", "float64"},
                                                            {"string", "string"}};
  return kTypes;
}

/// The ROS 2 name of a type in the IDL: of "geometry_msgs::msg::dds_::Pose_", or of "Pose_" within geometry_msgs, it is
/// "geometry_msgs/Pose".
std::string ros_type(const std::string& idl_type, const std::string& package) {
  const auto basic = basic_types().find(idl_type);
  if (basic != basic_types().end()) return basic->second;
  static const std::regex kScoped(R"((?:(\w+)::msg::dds_::)?(\w+)_)");
  std::smatch match;
  if (!std::regex_match(idl_type, match, kScoped)) throw std::invalid_argument("unknown type '" + idl_type + "'");
  return (match[1].matched ? match[1].str() : package) + "/" + match[2].str();
}

/// A member of an IDL struct as a line of a ROS 2 message definition: "float64[36] covariance".
std::string ros_field(const std::string& line, const std::string& package) {
  static const std::regex kSequence(R"(sequence<\s*([\w: ]+?)\s*>\s+(\w+);)");
  static const std::regex kMember(R"(([\w: ]+?)\s+(\w+)(\[\d+\])?;)");
  std::smatch match;
  if (std::regex_match(line, match, kSequence)) return ros_type(match[1], package) + "[] " + match[2].str() + "\n";
  if (std::regex_match(line, match, kMember)) {
    return ros_type(match[1], package) + match[3].str() + " " + match[2].str() + "\n";
  }
  throw std::invalid_argument("not understood in the IDL: '" + line + "'");
}

/// The line without its comment and the spaces around.
std::string bare(std::string line) {
  line = line.substr(0, line.find("//"));
  const auto first = line.find_first_not_of(" \t\r");
  return first == std::string::npos ? "" : line.substr(first, line.find_last_not_of(" \t\r") - first + 1);
}

std::string wire_name(const std::string& ros_name) {
  const std::size_t slash = ros_name.find('/');
  return ros_name.substr(0, slash) + "::msg::dds_::" + ros_name.substr(slash + 1) + "_";
}

using Fields = std::map<std::string, std::string>;

/// Appends the message types that `fields` names, and in turn those that these types name, each once, in the order in
/// which they first appear.
void collect_parts(const Fields& all, const std::string& fields, std::vector<std::string>& parts) {
  std::istringstream lines(fields);
  for (std::string type, name; lines >> type >> name;) {
    type = type.substr(0, type.find('['));
    if (type.find('/') == std::string::npos || std::ranges::find(parts, type) != parts.end()) continue;
    parts.push_back(type);
    collect_parts(all, all.at(wire_name(type)), parts);
  }
}

std::map<std::string, MessageDefinition> make_definitions() {
  Fields all;
  for (const std::string_view file : kIdlFiles) all.merge(ros_fields(file));
  std::map<std::string, MessageDefinition> definitions;
  for (const auto& [wire_type, fields] : all) {
    const std::string package = wire_type.substr(0, wire_type.find(':'));
    const std::size_t last = wire_type.rfind(':') + 1;
    MessageDefinition definition{package + "/msg/" + wire_type.substr(last, wire_type.size() - last - 1), fields};
    std::vector<std::string> parts;
    collect_parts(all, fields, parts);
    for (const std::string& part : parts) {
      definition.text += std::string(80, '=') + "\nMSG: " + part + "\n" + all.at(wire_name(part));
    }
    definitions.emplace(wire_type, std::move(definition));
  }
  return definitions;
}

}  // namespace

Fields ros_fields(std::string_view idl) {
  static const std::regex kModule(R"(module (\w+) \{ module msg \{ module dds_ \{)");
  static const std::regex kStruct(R"(@final struct (\w+)_ \{)");
  Fields structs;
  std::string package, current;
  std::istringstream lines{std::string(idl)};
  for (std::string line; std::getline(lines, line);) {
    line = bare(line);
    std::smatch match;
    if (line.empty() || line.starts_with('#') || line == "}; }; };") continue;
    if (std::regex_match(line, match, kModule)) {
      package = match[1];
    } else if (std::regex_match(line, match, kStruct)) {
      current = wire_name(package + "/" + match[1].str());
      structs[current] = "";
    } else if (line == "};") {
      current.clear();
    } else if (!current.empty()) {
      structs[current] += ros_field(line, package);
    } else {
      throw std::invalid_argument("not understood in the IDL: '" + line + "'");
    }
  }
  return structs;
}

const MessageDefinition& message_definition(const std::string& wire_type) {
  static const std::map<std::string, MessageDefinition> kDefinitions = make_definitions();
  return kDefinitions.at(wire_type);
}

}  // namespace skein
