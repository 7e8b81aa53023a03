// docs/result.schema.json rejects results that do not conform to it.
#include "json_schema.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/places.hpp"

namespace skein::test {
namespace {

using Json = nlohmann::json;

Json schema() { return Json::parse(std::ifstream(source_path("docs/result.schema.json"))); }

/// A minimal value that conforms to a schema: of several types the first one, of an object only the required keys.
Json example_of(const Json& schema) {
  if (schema.contains("enum")) return schema["enum"][0];
  const Json type = schema["type"].is_array() ? schema["type"][0] : schema["type"];
  if (type == "string") return "text";
  if (type == "boolean") return true;
  if (type == "integer") return 1;
  if (type == "number") return 1.5;
  if (type == "null") return nullptr;
  if (type == "array") {
    Json list = Json::array();
    for (std::size_t i = schema.value("minItems", 1u); i > 0; --i) list.push_back(example_of(schema["items"]));
    return list;
  }
  Json object = Json::object();
  for (const Json& key : schema.value("required", Json::array())) {
    const Json properties = schema.value("properties", Json::object());
    object[key] = example_of(properties.contains(key) ? properties[key] : schema["additionalProperties"]);
  }
  return object;
}

/// Calls `use` with each object within a value, and with the value itself if it is an object.
void each_object(Json& value, const auto& use) {
  if (value.is_object()) use(value);
  for (Json& part : value) {
    if (part.is_structured()) each_object(part, use);
  }
}

TEST(ResultSchema, AcceptsAConformingResult) {
  EXPECT_EQ(schema_errors(example_of(schema()), schema()), std::vector<std::string>());
}

TEST(ResultSchema, RefusesAMissingKey) {
  const Json wanted = schema();
  for (const Json& key : wanted["required"]) {
    Json result = example_of(wanted);
    result.erase(key.get<std::string>());
    EXPECT_FALSE(schema_errors(result, wanted).empty()) << key;
  }
}

TEST(ResultSchema, RefusesAWrongType) {
  const Json wanted = schema(), example = example_of(wanted);
  for (const auto& [key, value] : example.items()) {
    Json result = example;
    result[key] = value.is_number() ? Json("1") : Json(1);
    EXPECT_FALSE(schema_errors(result, wanted).empty()) << key;
  }
  Json result = example;
  result["seed"] = 1.5;
  EXPECT_FALSE(schema_errors(result, wanted).empty()) << "a number that is not whole was accepted";
  result["seed"] = -1;
  EXPECT_FALSE(schema_errors(result, wanted).empty()) << "a number below the minimum was accepted";
  result = example;
  result["status"] = "unheard of";
  EXPECT_FALSE(schema_errors(result, wanted).empty()) << "a value that is not listed was accepted";
  result = example;
  result["collisions"][0]["position"].erase(0);
  EXPECT_FALSE(schema_errors(result, wanted).empty()) << "a list that is too short was accepted";
}

TEST(ResultSchema, RefusesAnUnknownKeyInAnyObject) {
  Json example = example_of(schema());
  std::size_t objects = 0;
  each_object(example, [&](Json& object) {
    ++objects;
    object["unheard_of"] = Json::array();
    EXPECT_FALSE(schema_errors(example, schema()).empty()) << example.dump();
    object.erase("unheard_of");
  });
  EXPECT_GT(objects, 10u);
}

}  // namespace
}  // namespace skein::test
