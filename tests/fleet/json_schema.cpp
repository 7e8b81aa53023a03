#include "json_schema.hpp"

#include <algorithm>

namespace skein::test {
namespace {

using Json = nlohmann::json;

bool has_type(const Json& value, const std::string& type) {
  if (type == "integer") return value.is_number_integer();
  if (type == "number") return value.is_number();
  return type == value.type_name();
}

bool has_one_of(const Json& value, const Json& types) {
  if (types.is_string()) return has_type(value, types);
  return std::any_of(types.begin(), types.end(), [&](const Json& type) { return has_type(value, type); });
}

}  // namespace

std::vector<std::string> schema_errors(const Json& value, const Json& schema, const std::string& path) {
  std::vector<std::string> errors;
  const auto go_into = [&](const Json& part, const Json& part_schema, const std::string& part_path) {
    const auto more = schema_errors(part, part_schema, part_path);
    errors.insert(errors.end(), more.begin(), more.end());
  };
  if (schema.contains("type") && !has_one_of(value, schema["type"])) {
    return {path + " is " + value.dump().substr(0, 40) + ", must be of type " + schema["type"].dump()};
  }
  if (schema.contains("enum") && !std::count(schema["enum"].begin(), schema["enum"].end(), value)) {
    errors.push_back(path + " is " + value.dump() + ", must be one of " + schema["enum"].dump());
  }
  if (schema.contains("minimum") && value.is_number() && value < schema["minimum"]) {
    errors.push_back(path + " is " + value.dump() + ", below its minimum");
  }
  if (value.is_array()) {
    if (value.size() < schema.value("minItems", 0u)) errors.push_back(path + " is too short");
    for (std::size_t i = 0; schema.contains("items") && i < value.size(); ++i) {
      go_into(value[i], schema["items"], path + "[" + std::to_string(i) + "]");
    }
  }
  if (value.is_object()) {
    for (const Json& key : schema.value("required", Json::array())) {
      if (!value.contains(key)) errors.push_back(path + "." + key.get<std::string>() + " is missing");
    }
    const Json properties = schema.value("properties", Json::object());
    for (const auto& [key, part] : value.items()) {
      if (properties.contains(key))
        go_into(part, properties[key], path + "." + key);
      else if (schema.contains("additionalProperties"))
        go_into(part, schema["additionalProperties"], path + "." + key);
    }
  }
  return errors;
}

}  // namespace skein::test
