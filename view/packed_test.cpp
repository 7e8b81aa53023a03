#include "view/packed.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <vector>

#include "core/text/base64.hpp"

namespace skein::view {
namespace {

std::string unpacked(const std::string& text, std::size_t most) {
  const auto bytes = read_base64(text);
  std::string out(most, '\0');
  uLongf size = most;
  if (!bytes || ::uncompress(reinterpret_cast<Bytef*>(out.data()), &size, bytes->data(), bytes->size()) != Z_OK) {
    return "not packed";
  }
  out.resize(size);
  return out;
}

TEST(Packed, IsAZlibStreamInBase64) {
  std::string text = "{\"k\":\"pose\"}";
  for (int i = 0; i < 12; ++i) {
    EXPECT_EQ(unpacked(packed(text), text.size() + 1), text);
    text += text;
  }
  EXPECT_LT(packed(text).size(), text.size() / 50);
  EXPECT_EQ(unpacked(packed(""), 1), "");
}

}  // namespace
}  // namespace skein::view
