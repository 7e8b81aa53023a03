#include "uav_agent/api/payload.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "core/radio/radio_routes.hpp"

namespace skein::agent {
namespace {

PayloadWriter all_bytes() {
  PayloadWriter writer;
  for (int i = 0; i < 256; ++i) writer.u8(static_cast<std::uint8_t>(i));
  return writer;
}

TEST(Payload, NumbersAreReadAsTheyWereWritten) {
  PayloadWriter writer;
  writer.u8(200);
  writer.u16(51'234);
  writer.u32(4'000'000'001U);
  writer.position({-12.344, 0.0, 1234.5});
  PayloadReader reader(writer.data());
  EXPECT_EQ(reader.u8(), 200);
  EXPECT_EQ(reader.u16(), 51'234);
  EXPECT_EQ(reader.u32(), 4'000'000'001U);
  EXPECT_LT((reader.position() - Vector3d(-12.34, 0.0, 1234.5)).norm(), 1e-9);
  EXPECT_TRUE(reader.at_end());
}

TEST(Payload, ReadingPastTheEndGivesZerosAndIsReported) {
  PayloadWriter writer;
  writer.u8(7);
  PayloadReader reader(writer.data());
  EXPECT_EQ(reader.u32(), 0U);
  EXPECT_FALSE(reader.ok());
  EXPECT_EQ(reader.u8(), 0U) << "all further reads fail, too";
  EXPECT_FALSE(reader.ok());
}

TEST(Payload, AnyBytesTravelAsATextWithoutNul) {
  const RadioMessage message = send_payload("kios/1", 3, all_bytes());
  EXPECT_EQ(message.topic, kPlanTopic);
  EXPECT_EQ(message.text.find('\0'), std::string::npos);
  const auto opened = open_payload(message, "kios/1", 5);
  ASSERT_TRUE(opened);
  EXPECT_EQ(opened->sender, 3U);
  EXPECT_EQ(opened->bytes, all_bytes().data());
}

TEST(Payload, AMessageOfAnotherPlannerSenderOrTopicIsNotOpened) {
  const RadioMessage message = send_payload("kios/1", 3, all_bytes());
  EXPECT_FALSE(open_payload(message, "kios/2", 5));
  EXPECT_FALSE(open_payload(message, "kios/", 5));
  EXPECT_FALSE(open_payload(message, "star/1", 5));
  EXPECT_FALSE(open_payload(message, "kios/1", 3)) << "a fleet of three has no UAV 3";
  RadioMessage elsewhere = message;
  elsewhere.topic = "/broadcast";
  EXPECT_FALSE(open_payload(elsewhere, "kios/1", 5));
}

TEST(Payload, OnlyMessagesOfThePlannerAreOpenedAndInTheirOrder) {
  std::vector<RadioMessage> radio;
  for (const std::uint8_t sender : {2, 0, 1}) {
    radio.push_back(send_payload("star/1", sender, all_bytes()));
    radio.push_back(send_payload("kios/1", sender, PayloadWriter().u8(sender).u16(500)));
  }
  radio[3].text.pop_back();  // the message of UAV 0 is damaged
  const std::vector<Payload> opened = open_payloads(radio, "kios/1", 3);
  ASSERT_EQ(opened.size(), 2U);
  EXPECT_EQ(opened[0].sender, 2U);
  EXPECT_EQ(opened[1].sender, 1U);
  EXPECT_EQ(opened[1].bytes, (std::vector<std::uint8_t>{1, 244, 1}));
}

TEST(Payload, ADamagedMessageIsRefusedOrKeepsItsContent) {
  const RadioMessage message = send_payload("kios/1", 0, all_bytes());
  for (std::size_t i = 0; i < message.text.size(); ++i) {
    for (const char flip : {1, 16, -128}) {
      RadioMessage damaged = message;
      damaged.text[i] = static_cast<char>(damaged.text[i] ^ flip);
      const auto opened = open_payload(damaged, "kios/1", 1);
      EXPECT_TRUE(!opened || opened->bytes == all_bytes().data()) << "byte " << i;
    }
    RadioMessage cut = message;
    cut.text.resize(i);
    EXPECT_FALSE(open_payload(cut, "kios/1", 1)) << i;
  }
}

TEST(Payload, LengthIsBounded) {
  PayloadWriter writer;
  while (writer.room() > 0) writer.u8(0);
  EXPECT_EQ(writer.size(), kMaxPayloadBytes);
  EXPECT_TRUE(open_payload(send_payload("x", 0, writer), "x", 1));
  writer.u8(0);
  EXPECT_THROW(send_payload("x", 0, writer), std::logic_error);
}

}  // namespace
}  // namespace skein::agent
