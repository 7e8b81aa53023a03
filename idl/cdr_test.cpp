#include "idl/cdr.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <string>

#include "idl/filled_message.hpp"

namespace skein {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Bytes of an XCDR1 payload, laid out by hand: only pad() aligns.
class Layout {
 public:
  Layout() : bytes_{0, 1, 0, 0} {}  // CDR_LE, no options

  template <class T>
  Layout& put(T value) {
    std::array<std::uint8_t, sizeof(T)> raw;
    std::memcpy(raw.data(), &value, sizeof(T));
    bytes_.insert(bytes_.end(), raw.begin(), raw.end());
    return *this;
  }
  Layout& u8(std::uint8_t v) { return put(v); }
  Layout& u32(std::uint32_t v) { return put(v); }
  Layout& f64(double v) { return put(v); }
  Layout& text(const std::string& v) {
    u32(static_cast<std::uint32_t>(v.size() + 1));
    bytes_.insert(bytes_.end(), v.c_str(), v.c_str() + v.size() + 1);
    return *this;
  }
  Layout& pad(std::size_t count) {
    bytes_.insert(bytes_.end(), count, 0);
    return *this;
  }
  /// @param body_offset where the next byte must be, counted from the end of the encapsulation header
  Layout& at(std::size_t body_offset) {
    EXPECT_EQ(bytes_.size() - 4, body_offset);
    return *this;
  }
  const Bytes& bytes() const { return bytes_; }

 private:
  Bytes bytes_;
};

TEST(Cdr, OdometryHasItsLayout) {
  msg::Odometry message;
  message.header().stamp().sec(7);
  message.header().stamp().nanosec(8);
  message.header().frame_id("world");
  message.child_frame_id("a");
  message.pose().pose().position().y(1.5);
  message.pose().pose().orientation().w(1.0);
  message.pose().covariance()[35] = 2.5;
  message.twist().twist().angular().z(-3.0);
  message.twist().covariance()[0] = 4.5;

  Layout expected;
  expected.u32(7).u32(8).text("world").at(18).pad(2).text("a").at(26).pad(6);
  expected.at(32).f64(0).f64(1.5).f64(0).f64(0).f64(0).f64(0).f64(1.0);
  for (int i = 0; i < 36; ++i) expected.f64(i == 35 ? 2.5 : 0.0);
  expected.f64(0).f64(0).f64(0).f64(0).f64(0).f64(-3.0);
  for (int i = 0; i < 36; ++i) expected.f64(i == 0 ? 4.5 : 0.0);
  expected.at(712);
  EXPECT_EQ(encode(message), expected.bytes());
}

TEST(Cdr, PointCloudHasItsLayout) {
  msg::PointField field;
  field.name("x");
  field.offset(4);
  field.datatype(7);
  field.count(1);
  msg::PointCloud2 message;
  message.header().frame_id("w");
  message.height(1);
  message.width(2);
  message.fields().push_back(field);
  message.is_bigendian(true);
  message.point_step(16);
  message.row_step(32);
  message.data({0xaa, 0xbb, 0xcc});
  message.is_dense(true);

  Layout expected;
  expected.u32(0).u32(0).text("w").pad(2).at(16).u32(1).u32(2);
  expected.u32(1).text("x").pad(2).at(36).u32(4).u8(7).pad(3).u32(1);
  expected.at(48).u8(1).pad(3).u32(16).u32(32);
  expected.u32(3).at(64).u8(0xaa).u8(0xbb).u8(0xcc).u8(1).at(68);
  EXPECT_EQ(encode(message), expected.bytes());
}

TEST(Cdr, TrajectoryHasItsLayout) {
  msg::Transform transform;
  transform.translation().z(9.0);
  transform.rotation().w(1.0);
  msg::Twist velocity;
  velocity.linear().x(2.0);
  msg::MultiDOFJointTrajectoryPoint point;
  point.transforms().push_back(transform);
  point.velocities().push_back(velocity);
  point.time_from_start().sec(-1);
  point.time_from_start().nanosec(5);
  msg::MultiDOFJointTrajectory message;
  message.joint_names().push_back("j");
  message.points().push_back(point);

  Layout expected;
  expected.u32(0).u32(0).text("").at(13).pad(3).u32(1).text("j").pad(2).at(28).u32(1);
  expected.u32(1).pad(4).at(40).f64(0).f64(0).f64(9.0).f64(0).f64(0).f64(0).f64(1.0);
  expected.at(96).u32(1).pad(4).f64(2.0).f64(0).f64(0).f64(0).f64(0).f64(0);
  expected.at(152).u32(0).put(std::int32_t{-1}).u32(5).at(164);
  EXPECT_EQ(encode(message), expected.bytes());
}

TEST(Cdr, BigEndianIsUnderstood) {
  msg::Time message;
  ASSERT_TRUE(decode(Bytes{0, 0, 0, 0, 0, 0, 1, 2, 0, 0, 0, 3}, message));
  EXPECT_EQ(message.sec(), 258);
  EXPECT_EQ(message.nanosec(), 3u);
}

TEST(Cdr, PayloadsArePaddedWithZerosToAMultipleOfFour) {
  msg::String message;
  message.data("ab");
  EXPECT_EQ(encode(message), (Bytes{0, 1, 0, 0, 3, 0, 0, 0, 'a', 'b', 0, 0}));
}

TEST(Cdr, TypeNamesAreThoseOfRos) {
  EXPECT_EQ(type_name<msg::Odometry>(), "nav_msgs::msg::dds_::Odometry_");
  EXPECT_EQ(type_name<msg::Step>(), "skein_msgs::msg::dds_::Step_");
}

// ---- every type ------------------------------------------------------------------------------------------------

template <class T>
class EveryType : public testing::Test {};
TYPED_TEST_SUITE(EveryType, AllMessageTypes);

TYPED_TEST(EveryType, SurvivesTheRoundTrip) {
  const TypeParam message = filled_message<TypeParam>();
  const Bytes payload = encode(message);
  EXPECT_EQ(payload.size() % 4, 0u);
  TypeParam again;
  ASSERT_TRUE(decode(payload, again));
  EXPECT_TRUE(again == message);
  EXPECT_EQ(encode(again), payload);
}

TYPED_TEST(EveryType, SurvivesTruncationAnywhere) {
  const TypeParam message = filled_message<TypeParam>();
  const Bytes payload = encode(message);
  for (std::size_t size = 0; size < payload.size(); ++size) {
    // A copy, so that a memory checker notices a read beyond its end.
    const Bytes truncated(payload.begin(), payload.begin() + static_cast<long>(size));
    TypeParam again;
    // Only the padding at the end may be missing.
    if (decode(truncated, again)) {
      EXPECT_GE(size + 3, payload.size());
      EXPECT_TRUE(again == message);
    }
  }
}

TYPED_TEST(EveryType, SurvivesAnyWordBeingHuge) {
  const Bytes payload = encode(filled_message<TypeParam>());
  for (const std::uint32_t huge : {0xffffffffu, 0x7fffffffu, 0x10000000u, static_cast<std::uint32_t>(payload.size())})
    for (std::size_t at = 4; at + 4 <= payload.size(); at += 4) {
      Bytes damaged = payload;
      std::memcpy(damaged.data() + at, &huge, sizeof huge);
      TypeParam again;
      decode(damaged, again);
    }
}

TYPED_TEST(EveryType, SurvivesNoise) {
  std::uint64_t state = 1;
  for (int round = 0; round < 300; ++round) {
    Bytes noise(4 + static_cast<std::size_t>(round));
    for (auto& byte : noise) {
      state = state * 6364136223846793005 + 1442695040888963407;  // Knuth's MMIX generator
      byte = static_cast<std::uint8_t>(state >> 56);
      if (byte < 128) byte = 0;  // makes small lengths frequent, so that the reader gets beyond them
    }
    noise[0] = 0;
    noise[1] = static_cast<std::uint8_t>(round % 2);
    TypeParam message;
    decode(noise, message);
  }
}

TEST(Cdr, OtherRepresentationsAreRefused) {
  msg::Time message;
  const Bytes body(8);
  for (const auto& header : {Bytes{0, 2, 0, 0}, Bytes{0, 6, 0, 0}, Bytes{1, 1, 0, 0}, Bytes{0, 255, 0, 0}}) {
    Bytes payload = header;
    payload.insert(payload.end(), body.begin(), body.end());
    EXPECT_FALSE(decode(payload, message));
  }
}

}  // namespace
}  // namespace skein
