#include "core/text/base64.hpp"

#include <gtest/gtest.h>

namespace skein {
namespace {

std::string of(std::string_view text) {
  return base64({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

// RFC 4648, section 10.
TEST(Base64, WritesTheVectorsOfItsStandard) {
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("fo"), "Zm8=");
  EXPECT_EQ(of("foo"), "Zm9v");
  EXPECT_EQ(of("foob"), "Zm9vYg==");
  EXPECT_EQ(of("fooba"), "Zm9vYmE=");
  EXPECT_EQ(of("foobar"), "Zm9vYmFy");
}

TEST(Base64, ReadsWhatItWrote) {
  std::vector<std::uint8_t> bytes;
  for (unsigned i = 0; i < 600; ++i) {
    EXPECT_EQ(read_base64(base64(bytes)), bytes) << i;
    bytes.push_back(static_cast<std::uint8_t>(i * i + 7 * i));
  }
}

TEST(Base64, RefusesTextsThatAreNotBase64) {
  for (const char* text : {"Z", "Zg", "Zg=", "Zg=a", "Z===", "====", "Zm9v\n", "Zm 9", "Zm9_", "=Zm9"}) {
    EXPECT_EQ(read_base64(text), std::nullopt) << text;
  }
}

}  // namespace
}  // namespace skein
