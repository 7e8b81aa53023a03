#include "core/config/config_reader.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "core/config/config_writer.hpp"

namespace skein {
namespace {

enum class Colour { red, green };
constexpr std::array<EnumName<Colour>, 2> enum_names(Colour) {
  return {{{"red", Colour::red}, {"green", Colour::green}}};
}

struct Part {
  std::string name;
  double length_m = 1.0;

  void describe(auto& r) {
    r.required("name", name);
    r.field("length_m", length_m, above(0.0));
  }
};

struct Everything {
  bool flag = false;
  int small = 1;
  std::int64_t whole = 2;
  std::uint64_t seed = 3;
  double real = 4.0;
  std::string text = "five";
  std::filesystem::path path = "six";
  Colour colour = Colour::red;
  Vector2d flat = {7, 8};
  Vector3d space = {9, 10, 11};
  std::array<double, 4> four = {1, 2, 3, 4};
  Part part = {"only", 1.0};
  std::vector<Part> parts = {};
  std::vector<std::string> words = {};
  std::optional<Part> maybe = {};
  std::variant<std::string, Part> either = std::string("word");
  Named<double> named = {};

  void describe(auto& r) {
    r.field("flag", flag);
    r.field("small", small, within(0, 10));
    r.field("whole", whole);
    r.field("seed", seed);
    r.field("real", real);
    r.field("text", text);
    r.field("path", path);
    r.field("colour", colour);
    r.field("flat", flat);
    r.field("space", space, at_least(-100.0));
    r.field("four", four);
    r.field("part", part);
    r.field("parts", parts);
    r.field("words", words);
    r.field("maybe", maybe);
    r.field("either", either);
    r.field("named", named);
    r.check(real != 13.0, "real", "13 brings bad luck");
  }
};

Everything parse(const std::string& text) { return read_config<Everything>(parse_config_document(text, "test")); }

std::string complaint(const std::string& text) {
  try {
    parse(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ConfigReader, AnAbsentKeyKeepsItsDefault) {
  EXPECT_EQ(config_to_yaml(parse("{}")), config_to_yaml(Everything()));
  EXPECT_EQ(config_to_yaml(parse("")), config_to_yaml(Everything()));
}

TEST(ConfigReader, ReadsEveryType) {
  const Everything read = parse(R"(
flag: true
small: +7
whole: -9223372036854775808
seed: 18446744073709551615
real: -1.5e-3
text: "a: b # c"
path: models/x.stl
colour: green
flat: [1, 2.5]
space:
  - 1
  - 2
  - 3
four: [4, 3, 2, 1]
part: {name: wing, length_m: 2}
parts:
  - name: tail
  - {name: nose, length_m: 0.5}
words: [a, "2", c d]
maybe: {name: perhaps}
either: {name: struct}
named: {x: 1, y: 2}
)");
  EXPECT_TRUE(read.flag);
  EXPECT_EQ(read.small, 7);
  EXPECT_EQ(read.whole, std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(read.seed, std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(read.real, -1.5e-3);
  EXPECT_EQ(read.text, "a: b # c");
  EXPECT_EQ(read.path, "models/x.stl");
  EXPECT_EQ(read.colour, Colour::green);
  EXPECT_EQ(read.flat, Vector2d(1, 2.5));
  EXPECT_EQ(read.space, Vector3d(1, 2, 3));
  EXPECT_EQ(read.four[0], 4.0);
  EXPECT_EQ(read.part.length_m, 2.0);
  ASSERT_EQ(read.parts.size(), 2u);
  EXPECT_EQ(read.parts[0].name, "tail");
  EXPECT_EQ(read.parts[1].length_m, 0.5);
  EXPECT_EQ(read.words, (std::vector<std::string>{"a", "2", "c d"}));
  ASSERT_TRUE(read.maybe);
  EXPECT_EQ(read.maybe->name, "perhaps");
  EXPECT_EQ(std::get<Part>(read.either).name, "struct");
  EXPECT_EQ(read.named, (Named<double>{{"x", 1.0}, {"y", 2.0}}));
  EXPECT_EQ(config_to_yaml(parse(config_to_yaml(read))), config_to_yaml(read));
}

TEST(ConfigReader, AnErrorNamesThePlaceAndACorrectValue) {
  EXPECT_EQ(complaint("small: 11"), "test:1: small: must be a whole number within [0, 10], not '11'");
  EXPECT_EQ(complaint("\n\nspace: [1, 2, -101]"), "test:3: space[2]: must be a number of at least -100, not '-101'");
  EXPECT_EQ(complaint("parts:\n  - name: a\n  - name: b\n    length_m: 0"),
            "test:4: parts[1].length_m: must be a number above 0, not '0'");
  EXPECT_EQ(complaint("parts: [{length_m: 1}]"), "test:1: missing key 'parts[0].name': it is required");
  EXPECT_EQ(complaint("named: {x: y}"), "test:1: named.x: must be a number, not 'y'");
  EXPECT_EQ(complaint("either: [1]"), "test:1: either: must be a map of keys, not a list");
  EXPECT_EQ(complaint("colour: blue"), "test:1: colour: must be one of red, green, not 'blue'");
  EXPECT_EQ(complaint("flag: yes"), "test:1: flag: must be true or false, not 'yes'");
  EXPECT_EQ(complaint("real: 13"), "test:1: real: 13 brings bad luck");
  EXPECT_EQ(complaint("seed: 18446744073709551616"),
            "test:1: seed: must be a whole number of at least 0, not '18446744073709551616'");
}

TEST(ConfigReader, ATextInAnotherEncodingIsRefusedWithItsLine) {
  EXPECT_EQ(complaint("flag: true\nname: caf\xE9"), "test:2: not in UTF-8; convert the file, for example with iconv");
  EXPECT_EQ(complaint("flag: true  # caf\xE9\n"), "test:1: not in UTF-8; convert the file, for example with iconv");
  EXPECT_EQ(complaint("flag: true  # caf\xC3\xA9\n"), "accepted");
  EXPECT_EQ(complaint("\xEF\xBB\xBF"
                      "flag: true\n"),
            "accepted")
      << "a byte order mark is accepted";
}

TEST(ConfigReader, NumbersHaveAStrictSyntax) {
  for (const char* number : {"1.", ".5", "1e3", "+2", "-0", "007"}) {
    EXPECT_EQ(complaint("real: " + std::string(number)), "accepted") << number;
  }
  for (const char* number : {"inf", ".inf", ".nan", "nan", "0x10", "1_000", "1,5", "1 2", "'1'", "1e999", "+-1", "--1",
                             "one", "1m", "~", "[1]", "true"}) {
    EXPECT_NE(complaint("real: " + std::string(number)), "accepted") << number;
  }
}

TEST(ConfigReader, ReportsAllErrorsInTheOrderOfTheFile) {
  EXPECT_EQ(complaint("real: x\nsmal: 1\nflag: 3"),
            "test:1: real: must be a number, not 'x'\n"
            "test:2: unknown key 'smal'; did you mean 'small'?\n"
            "test:3: flag: must be true or false, not '3'");
  std::string many;
  for (int i = 0; i < 30; ++i) many += "unheard_of_" + std::to_string(i) + ": 1\n";
  EXPECT_TRUE(complaint(many).ends_with("\nand 20 more"));
}

/// The place that the reader reports for the letter 'X' in the value of `text`.
std::string place_of_x(const std::string& yaml) {
  const ConfigDocument document = parse_config_document(yaml, "test");
  ConfigErrors errors(document);
  errors.add_at("text", document.root.find("text")->scalar.find('X'), "here");
  try {
    errors.throw_if_any();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// The reader finds a letter's line and column in all forms in which YAML texts can be written.
TEST(ConfigReader, FindsALetterOfATextInItsLines) {
  for (const char* yaml : {"text: abX", "text:   a b   X c", "text: 'a X'", "text: \"a b X\"",
                           "flag: true\ntext: a\n   b\n     X c", "text: >\n  a b\n  c X\n", "text: |\n  a\n  X\n",
                           "flag: true\ntext: \"a\n  b X\"\nsmall: 3", "{flag: true, text: a X b}"}) {
    const std::string text = yaml;
    const std::size_t at = text.find('X'), line_begin = at == 0 ? 0 : text.rfind('\n', at);
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    const std::size_t column = line_begin == std::string::npos ? at + 1 : at - line_begin;
    EXPECT_EQ(place_of_x(text), "test:" + std::to_string(line) + ":" + std::to_string(column) + ": text: here") << text;
  }
  EXPECT_EQ(place_of_x("text: abc"), "test:1:10: text: here") << "a text without the letter: the place behind its end";
}

TEST(ConfigReader, AnEmptyValueLeavesAnOptionalUnset) {
  EXPECT_FALSE(parse("maybe:").maybe.has_value());
  EXPECT_FALSE(parse("maybe: ~").maybe.has_value());
}

// yaml-cpp would give the line of the next node.
TEST(ConfigReader, AnEmptyValueIsReportedInTheLineOfItsKey) {
  EXPECT_EQ(complaint("flag: true\nreal:\n\n\n# a comment\nsmall: 3\n"), "test:2: real: must be a number, not nothing");
  EXPECT_EQ(parse_config_document("part:\n  name:\n\n\nwords: []\n", "test").root.find("part")->find("name")->line, 2);
}

TEST(ConfigReader, AKeyWithDotsHasItsLine) {
  EXPECT_EQ(complaint("named:\n  x: 1\n  ../y.z: one\n"), "test:3: named.../y.z: must be a number, not 'one'");
  EXPECT_EQ(parse("named: {a: 1, a.b: 2}").named.size(), 2U);
}

TEST(ConfigReader, ReadsAssignmentsOfACommandLine) {
  const auto part = read_config<Part>(parse_assignments("name=wing,length_m=2.5", "--planner"));
  EXPECT_EQ(part.name, "wing");
  EXPECT_EQ(part.length_m, 2.5);
  for (const char* bad :
       {"name", "name=", "=wing", "name=a,name=b", "name=a,,", "name=a,", ",name=a", "name=a,colour=red"}) {
    EXPECT_THROW(read_config<Part>(parse_assignments(bad, "--planner")), InputError) << bad;
  }
}

TEST(ConfigWriter, QuotesTextsThatWouldBeReadAsSomethingElse) {
  for (const char* text : {"true", "12", "a: b", "- x", "-", "", "#", "it's \"so\"", "two\nlines", "a\ttab",
                           "back\\slash", "~", "null", "NULL", "---", "...", "Zürich", "/chat"}) {
    Everything value;
    value.text = text;
    if (!std::strchr(text, '\n')) value.named = {{text, 1.0}};  // a key cannot contain line breaks
    const Everything again = parse(config_to_yaml(value));
    EXPECT_EQ(again.text, text);
    EXPECT_EQ(again.named, value.named) << text;
  }
}

TEST(ConfigWriter, PrintsTheTreeThatItRead) {
  const std::string text =
      "word: a/b-c\n\"two words\": \"12\"\nnumber: -1.5e-07\nnothing: ~\nempty: {}\nlist: [1, \"a b\", ~]\n"
      "maps:\n  - name: a\n    inner:\n      - [1, 2]\n      - []\n  - name: b\n";
  EXPECT_EQ(to_yaml(parse_config_document(text, "test").root), text);
}

}  // namespace
}  // namespace skein
