#include "core/text/utf8.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

namespace skein {
namespace {

/// Whether the library that writes Skein's files can represent the text.
bool json_holds(const std::string& text) try {
  return !nlohmann::json(text).dump().empty();
} catch (const nlohmann::json::exception&) {
  return false;
}

TEST(Utf8, IsValidIfJsonCanRepresentIt) {
  const std::vector<std::string> parts = {"a",        "\xe9",         "\xc3\xa9",         "\xff",     "\xe2\x80\xa8",
                                          "\xc0\x80", "\xed\xa0\x80", "\xf0\x9f\x98\x80", "\xf4\x90", "\x80"};
  std::mt19937 draw(1);
  int valid = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string text;
    for (std::size_t length = draw() % 4; length > 0; --length) text += parts[draw() % parts.size()];
    EXPECT_EQ(is_utf8(text), json_holds(text)) << ::testing::PrintToString(text);
    valid += is_utf8(text) ? 1 : 0;
  }
  EXPECT_GT(valid, 200);
  EXPECT_LT(valid, 1800);
}

TEST(Utf8, FirstBytesNeverCutACharacter) {
  const std::string text = "a\xc3\xa9\xf0\x9f\x98\x80";  // of 1, 2 and 4 bytes
  const std::vector<std::size_t> lengths = {0, 1, 1, 3, 3, 3, 3, 7, 7};
  for (std::size_t most = 0; most < lengths.size(); ++most) {
    EXPECT_EQ(first_bytes(text, most), text.substr(0, lengths[most])) << most;
  }
  EXPECT_EQ(first_bytes(std::string(9, '\x80'), 5), std::string(2, '\x80')) << "at most 3 bytes fewer";
}

}  // namespace
}  // namespace skein
