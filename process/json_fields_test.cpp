// Structs are written as JSON and read back. Values that do not fit are ignored.
#include "process/json_fields.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace skein {
namespace {

struct Part {
  std::string name;
  bool operator==(const Part&) const = default;
};
void describe(auto& f, Part& part) { f.field("name", part.name); }

struct Whole {
  bool flag = true;
  int small = -1;
  std::uint64_t big = 0;
  double real = 0.5;
  std::string text = "as it was";
  Role role = Role::photographer;
  std::optional<double> absent, null;
  std::vector<Part> parts;
  std::array<double, 2> pair{};
  Named<int> named;
  Json raw = Json::object();
  std::filesystem::path file;
  bool operator==(const Whole&) const = default;
};
void describe(auto& f, Whole& whole) {
  f.field("small", whole.small);
  f.field("flag", whole.flag);
  f.field("big", whole.big);
  f.field("real", whole.real);
  f.field("text", whole.text);
  f.field("role", whole.role);
  f.field("absent", whole.absent);
  f.nullable("null", whole.null);
  f.field("parts", whole.parts);
  f.field("pair", whole.pair);
  f.field("named", whole.named);
  f.field("raw", whole.raw);
  f.field("file", whole.file);
}

Whole some() {
  return {.flag = false,
          .small = -7,
          .big = std::numeric_limits<std::uint64_t>::max(),
          .real = 0.1,
          .text = "\"quoted\"\n",
          .role = Role::explorer,
          .absent = 1.5,
          .null = -2.5,
          .parts = {{"a"}, {"b"}},
          .pair = {3.0, 4.0},
          .named = {{"z", 1}, {"a", 2}},
          .raw = {{"any", {1, nullptr}}},
          .file = "a folder/b"};
}

TEST(JsonFields, ReadsBackWhatItWrites) {
  for (const Whole& whole : {Whole(), some()}) {
    EXPECT_EQ(struct_of<Whole>(json_of(whole)), whole);
    EXPECT_EQ(struct_of<Whole>(parse_json(json_of(whole).dump())), whole);
  }
}

TEST(JsonFields, AnAmountIsNeverNegative) {
  EXPECT_EQ(json_detail::read<Amount>(parse_json("1.5")).value_or(0.0), 1.5);
  for (const char* wrong : {"-1e-9", "-31.03", "\"1\"", "null"}) {
    EXPECT_FALSE(json_detail::read<Amount>(parse_json(wrong))) << wrong;
  }
  EXPECT_EQ(json_of(Amount(2.5)), Json(2.5));
}

TEST(JsonFields, KeysHaveTheOrderOfTheListOfFields) {
  Whole whole = some();
  whole.absent.reset();
  whole.null.reset();
  EXPECT_EQ(json_of(whole).dump(),
            R"({"small":-7,"flag":false,"big":18446744073709551615,"real":0.1,"text":"\"quoted\"\n","role":"explorer",)"
            R"("null":null,"parts":[{"name":"a"},{"name":"b"}],"pair":[3.0,4.0],"named":{"z":1,"a":2},)"
            R"("raw":{"any":[1,null]},"file":"a folder/b"})");
}

TEST(JsonFields, AMissingKeyOrAValueOfAnotherKindLeavesTheDefault) {
  const Json good = json_of(some());
  const Json no_object = Json::array();
  EXPECT_EQ(struct_of<Whole>(no_object), Whole());
  const Json wrong =
      Json::array({nullptr, true, -1.5e300, "no such role", Json::array({1}), Json::object({{"x", "y"}})});
  for (const auto& [key, value] : good.items()) {
    Json lacking = good;
    lacking.erase(key);
    nlohmann::json expected = json_of(Whole());  // unlike Json, it ignores the order of the keys
    for (const auto& [other, known] : good.items()) {
      if (other != key) expected[other] = known;
    }
    EXPECT_EQ(nlohmann::json(json_of(struct_of<Whole>(lacking))), expected) << key;
    for (const Json& odd : wrong) {
      Json damaged = good;
      damaged[key] = odd;
      const Whole read = struct_of<Whole>(damaged);                      // must not throw
      const bool may_fit = odd.type() == value.type() && key != "role";  // a role is a text, but one of a few
      if (!may_fit) {
        EXPECT_EQ(nlohmann::json(json_of(read)), expected) << key << ": " << odd;
      }
    }
  }
}

TEST(JsonFields, NumbersThatAreTooLargeForTheFieldDoNotFit) {
  const auto small_of = [](const Json& number) { return struct_of<Whole>({{"small", number}}).small; };
  EXPECT_EQ(small_of(2.75), 2);
  EXPECT_EQ(small_of(1e10), -1);
  EXPECT_EQ(small_of(std::numeric_limits<double>::infinity()), -1);
  EXPECT_EQ(small_of(std::numeric_limits<double>::quiet_NaN()), -1);
  EXPECT_EQ(small_of(std::int64_t{1} << 40), -1);
  EXPECT_EQ(struct_of<Whole>({{"big", -3}}).big, 0U);
}

TEST(JsonFields, ElementsThatDoNotFitAreLeftOut) {
  const Whole whole = struct_of<Whole>(
      {{"parts", {{{"name", "a"}}, 3, nullptr, {{"name", "b"}}}}, {"named", {{"a", 1}, {"b", "x"}}}, {"pair", {1.0}}});
  EXPECT_EQ(whole.parts, (std::vector<Part>{{"a"}, {"b"}}));
  EXPECT_EQ(whole.named, (Named<int>{{"a", 1}}));
  EXPECT_EQ(whole.pair, (std::array<double, 2>{}));
}

}  // namespace
}  // namespace skein
