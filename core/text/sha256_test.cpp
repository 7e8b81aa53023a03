#include "core/text/sha256.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace skein {
namespace {

std::string hex_of_bytes(const std::string& text) {
  const std::vector<std::uint8_t> bytes(text.begin(), text.end());
  return Sha256().add(std::span<const std::uint8_t>(bytes)).hex();
}

TEST(Sha256, AgreesWithTheExamplesOfItsStandard) {  // FIPS 180-4
  EXPECT_EQ(hex_of_bytes(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(hex_of_bytes("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Sha256, NumbersAreEightLittleEndianBytes) {
  const std::vector<std::uint8_t> bytes = {0x02, 0x01, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(Sha256().add(0x0102).hex(), Sha256().add(std::span<const std::uint8_t>(bytes)).hex());
  const std::vector<std::uint8_t> one = {0, 0, 0, 0, 0, 0, 0xf0, 0x3f};
  EXPECT_EQ(Sha256().add(1.0).hex(), Sha256().add(std::span<const std::uint8_t>(one)).hex());
  EXPECT_EQ(Sha256().add(-1).hex(), Sha256().add(std::numeric_limits<std::uint64_t>::max()).hex());
}

TEST(Sha256, DifferentFieldsHaveDifferentDigests) {
  EXPECT_NE(Sha256().add("ab").add("c").hex(), Sha256().add("a").add("bc").hex());
  EXPECT_NE(Sha256().add(0.0).hex(), Sha256().add(-0.0).hex());
  EXPECT_NE(Sha256().add(1).hex(), Sha256().add(1.0).hex());
  EXPECT_NE(Sha256().add(Vector3d(1, 2, 3)).hex(), Sha256().add(Vector3d(1, 3, 2)).hex());
}

TEST(Sha256, MayBeContinuedAfterADigest) {
  Sha256 running;
  running.add("first");
  const std::string after_first = running.hex();
  EXPECT_EQ(running.hex(), after_first);
  const Sha256 copy = running;
  running.add("second");
  EXPECT_EQ(running.hex(), Sha256().add("first").add("second").hex());
  EXPECT_EQ(copy.hex(), after_first);
}

}  // namespace
}  // namespace skein
