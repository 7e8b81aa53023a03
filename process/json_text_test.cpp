#include "process/json_text.hpp"

#include <gtest/gtest.h>

#include <random>

namespace skein {
namespace {

Json nested(int depth) {
  Json json = 1;
  for (int i = 0; i < depth; ++i) json = i % 2 == 0 ? Json::array({0, json}) : Json{{"key", json}, {"other", 2}};
  return json;
}

int depth_of(const Json& json) {
  int deepest = 0;
  for (const Json& value : json) deepest = std::max(deepest, json.is_structured() ? 1 + depth_of(value) : 0);
  return deepest;
}

/// Random JSON. Its texts contain brackets, quotes and backslashes.
Json drawn(std::mt19937& random, int depth) {
  const auto below = [&](unsigned end) { return random() % end; };
  const auto text = [&] {
    std::string text;
    for (unsigned i = below(12); i > 0; --i) text += "[{]}\"\\ax\n"[below(9)];
    return text;
  };
  Json json;
  switch (depth > 0 ? below(5) : 2 + below(3)) {
    case 0:
      json = Json::array();
      for (unsigned i = below(4); i > 0; --i) json.push_back(drawn(random, depth - 1));
      return json;
    case 1:
      json = Json::object();
      for (unsigned i = below(4); i > 0; --i) json[text()] = drawn(random, depth - 1);
      return json;
    case 2:
      return text();
    case 3:
      return static_cast<int>(below(1000)) - 500;
    default:
      return nullptr;
  }
}

TEST(JsonText, JsonThatWasWrittenIsReadAgain) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 500; ++trial) {
    const Json json = drawn(random, 6);
    EXPECT_EQ(parse_json(json.dump()), json);
    EXPECT_EQ(parse_json(json.dump(2)), json);
  }
}

TEST(JsonText, ValuesThatAreTooDeepAreLeftOutAndTheRestStays) {
  for (int depth = 0; depth <= 32; ++depth) EXPECT_EQ(parse_json(nested(depth).dump()), nested(depth)) << depth;
  for (const int depth : {34, 40, 1000}) {
    const Json read = parse_json(nested(depth).dump());
    EXPECT_LE(depth_of(read), 33) << depth;
    EXPECT_GT(depth_of(read), 30) << depth;
  }
}

TEST(JsonText, BracketsWithinTextsDoNotCountAsDepth) {
  const Json json = {{std::string(100, '{'), std::string(100, '[')}, {"\\\"[[", std::string(100, '\\') + "\"[["}};
  EXPECT_EQ(parse_json(json.dump()), json);
}

TEST(JsonText, TextThatIsNotJsonIsReadAsNull) {
  for (const char* text : {"", "{", "[1,", "\"", "\"\\", "]]]]", "{\"a\": }", "nan"}) {
    EXPECT_TRUE(parse_json(text).is_null()) << text;
  }
  EXPECT_TRUE(parse_json(std::string(100'000, '[')).is_null());
  EXPECT_TRUE(parse_json(std::string(100'000, '{')).is_null());
}

}  // namespace
}  // namespace skein
