#include "results/result_keys.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/places.hpp"

namespace skein::results {
namespace {

/// A value of a kind that this part of the schema does not allow.
Json wrong_for(const Json& part) {
  const Json& types = part["type"];
  const Json& type = types.is_array() ? types[0] : types;
  return type == "string" ? Json(3) : Json("3");
}

Json schema_of_results() { return read_json(source_path("docs/result.schema.json")); }

TEST(ResultKeys, AValueOfAnotherKindThanInTheSchemaIsNamedWithItsKey) {
  const Json schema = schema_of_results();
  for (const auto& [key, part] : schema["properties"].items()) {
    if (key == "rules" || key == "checksum") continue;  // `rules` may have two kinds, and no reader uses `checksum`
    Json result = {{"status", "completed"}};
    result[key] = wrong_for(part);
    const std::string wrong = wrong_key(result);
    EXPECT_TRUE(wrong.starts_with(key + ": must be ")) << key << ": " << wrong;
    EXPECT_TRUE(wrong.ends_with(", not " + result[key].dump())) << key << ": " << wrong;
  }
  for (const auto& [key, part] : schema["properties"]["uavs"]["items"]["properties"].items()) {
    if (key == "from_nodes" || key == "battery") continue;  // no page reads their values one by one
    Json result = {{"status", "completed"}, {"uavs", Json::array({{{"name", "a"}}, {{"name", "b"}}})}};
    result["uavs"][1][key] = wrong_for(part);
    const std::string wrong = wrong_key(result);
    EXPECT_TRUE(wrong.starts_with("uavs[1]." + key + ": must be ")) << key << ": " << wrong;
  }
}

TEST(ResultKeys, EachKeyButTheStatusMayBeNullOrMissing) {
  const Json schema = schema_of_results();
  Json result = {{"status", "aborted"}};
  EXPECT_EQ(wrong_key(result), "");
  for (const auto& [key, part] : schema["properties"].items()) {
    if (key != "status") result[key] = nullptr;
  }
  EXPECT_EQ(wrong_key(result), "");
  const std::string none = "status: is missing, so it is not the result of a run";
  for (const char* text : {"{}", R"({"status": null})", R"({"score": 3})"})
    EXPECT_EQ(wrong_key(parse_json(text)), none);
}

TEST(ResultKeys, InnerKeysAreNamedWithTheOuterOnes) {
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {R"("score_by_uav": {"a": 1, "b": "2"})", "score_by_uav.b: must be a number, not \"2\""},
      {R"("losses": {"blur": {"points": 3, "score": []}})", "losses.blur.score: must be a number, not an array"},
      {R"("losses": {"below_threshold": {"by_part": {"tilt": {"points": "3"}}}})",
       "losses.below_threshold.by_part.tilt.points: must be a number, not \"3\""},
      {R"("losses": {"blur": 3})", "losses.blur: must be an object, not 3"},
      {R"("attainable": {"points": null, "score": "9"})", "attainable.score: must be a number, not \"9\""},
      {R"("uavs": [{"name": "a"}, 7])", "uavs[1]: must be an object, not 7"},
      {R"("collisions": [{"time_s": {}}])", "collisions[0].time_s: must be a number, not an object"},
      {R"("warnings": ["w", 1])", "warnings[1]: must be a text, not 1"},
      {R"("command": 1)", "command: must be a text, not 1"},
      {R"("score": ")" + std::string(99, '9') + "\"", "score: must be a number, not a long text"}};
  for (const auto& [key, said] : wrong) {
    EXPECT_EQ(wrong_key(parse_json(R"({"status": "completed", )" + key + "}")), said) << key;
  }
}

}  // namespace
}  // namespace skein::results
