#include "recording/mcap/records.hpp"

#include <gtest/gtest.h>

#include <random>

namespace skein::mcap {
namespace {

TEST(McapRecords, EachKindReadsBackAsItWasWritten) {
  const Schema schema{7, "nav_msgs/msg/Odometry", "ros2msg", "std_msgs/Header header\n"};
  const Channel channel{300, 7, "/jurong/\"odd\"\n", "cdr", {{"a", ""}, {"", "b"}}};
  Bytes bytes;
  append(bytes, schema);
  append(bytes, channel);
  append(bytes, Metadata{"run", {{"seed", "3"}}});
  append(bytes, MessageIndex{300, {{1, 2}, {~0ULL, 4}}});
  ByteView left(bytes);
  EXPECT_EQ(parse<Schema>(take_record(left)->content), schema);
  EXPECT_EQ(parse<Channel>(take_record(left)->content), channel);
  EXPECT_EQ(parse<Metadata>(take_record(left)->content)->entries.at("seed"), "3");
  const auto index = parse<MessageIndex>(take_record(left)->content);
  EXPECT_EQ(index->entries, (std::vector<std::pair<std::uint64_t, std::uint64_t>>{{1, 2}, {~0ULL, 4}}));
  EXPECT_TRUE(left.empty());
  EXPECT_FALSE(take_record(left));
}

// The layout that the specification gives: an opcode, eight bytes of length, then the fields, little-endian.
TEST(McapRecords, HaveTheBytesOfTheSpecification) {
  Bytes bytes;
  const Bytes data{0xAB, 0xCD};
  append(bytes, Message{0x0102, 3, 4, 5, data});
  const Bytes expected{0x05, 24,   0, 0, 0, 0, 0, 0, 0,  // opcode, length
                       0x02, 0x01, 3, 0, 0, 0,           // channel, sequence
                       4,    0,    0, 0, 0, 0, 0, 0,     // logged
                       5,    0,    0, 0, 0, 0, 0, 0,     // published
                       0xAB, 0xCD};
  EXPECT_EQ(bytes, expected);
}

TEST(McapRecords, TheChecksumIsTheCommonCrc32) {
  const std::string text = "123456789";
  const ByteView bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  EXPECT_EQ(crc_of(bytes), 0xCBF43926U);
  EXPECT_EQ(crc_of(bytes.subspan(4), crc_of(bytes.first(4))), 0xCBF43926U);
}

TEST(McapRecords, ATruncatedRecordIsNotRead) {
  Bytes whole;
  append(whole, Channel{1, 2, "/topic", "cdr", {{"key", "value"}}});
  for (std::size_t length = 0; length < whole.size(); ++length) {
    ByteView left = ByteView(whole).first(length);
    EXPECT_FALSE(take_record(left)) << length;
    EXPECT_EQ(left.size(), length);
    if (length < kRecordHead) continue;
    EXPECT_FALSE(parse<Channel>(left.subspan(kRecordHead))) << length;
  }
}

// A parser must return for every damaged file, and must not allocate the memory that damaged lengths state.
TEST(McapRecords, NoiseIsParsedWithoutErrorsAndWithoutLargeLists) {
  std::mt19937_64 random(20'261);
  for (int round = 0; round < 20'000; ++round) {
    Bytes noise(random() % 60);
    for (std::uint8_t& byte : noise) byte = static_cast<std::uint8_t>(random() % 4 == 0 ? 0xFF : random() % 9);
    ByteView left(noise);
    while (const auto record = take_record(left)) static_cast<void>(record);
    static_cast<void>(parse<Schema>(noise));
    static_cast<void>(parse<Channel>(noise));
    static_cast<void>(parse<Message>(noise));
    static_cast<void>(parse<Chunk>(noise));
    static_cast<void>(parse<Metadata>(noise));
    const auto index = parse<MessageIndex>(noise);
    EXPECT_LE(index ? index->entries.size() * 16 : 0, noise.size());
  }
}

}  // namespace
}  // namespace skein::mcap
