#include "uav_agent/uplink.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/random_stream.hpp"

namespace skein::agent {
namespace {

CaptureReport report(std::uint64_t capture, std::size_t bytes = 100) {
  return {capture, std::vector<std::uint8_t>(bytes, static_cast<std::uint8_t>(capture))};
}

TEST(Uplink, SendsNothingWithoutALink) {
  Uplink uplink;
  uplink.take({report(0), report(1)});
  EXPECT_TRUE(uplink.send(0, false).empty());
  EXPECT_EQ(uplink.send(1, true).size(), 2U);
  EXPECT_EQ(uplink.undelivered(), 2U) << "until they are acknowledged";
}

TEST(Uplink, SendsAgainOnlyAfterAWhile) {
  Uplink uplink({.max_bytes_per_step = 1000, .resend_after_steps = 5});
  uplink.take({report(3)});
  EXPECT_EQ(uplink.send(10, true).size(), 1U);
  for (std::uint64_t k = 11; k < 15; ++k) EXPECT_TRUE(uplink.send(k, true).empty());
  EXPECT_EQ(uplink.send(15, true).size(), 1U);
  uplink.acknowledge({3});
  EXPECT_TRUE(uplink.send(40, true).empty());
}

TEST(Uplink, BoundsBytesAndKeepsOrderButNeverStarves) {
  Uplink uplink({.max_bytes_per_step = 250, .resend_after_steps = 100});
  uplink.take({report(5), report(2), report(9), report(4, 9000)});
  std::vector<std::uint64_t> order;
  for (std::uint64_t k = 0; k < 10; ++k) {
    std::size_t bytes = 0;
    const auto sent = uplink.send(k, true);
    for (const auto& r : sent) {
      order.push_back(r.capture);
      bytes += r.payload.size();
    }
    EXPECT_TRUE(bytes <= 250 || sent.size() == 1);
  }
  EXPECT_EQ(order, (std::vector<std::uint64_t>{2, 4, 5, 9}));
}

TEST(Uplink, IgnoresWhatTheCameraRepeatsAfterARestart) {
  Uplink uplink;
  uplink.take({report(0), report(1), report(2)});
  uplink.acknowledge({0, 2});
  uplink.take({report(0), report(1), report(2), report(3)});
  EXPECT_EQ(uplink.undelivered(), 2U);
}

// Radio that loses messages and links both ways, whatever the order of events: all arrives, and nothing but
// what was taken.
TEST(Uplink, DeliversEverythingThroughABadRadio) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomStream random(seed, "radio", 0);
    Uplink uplink({.max_bytes_per_step = 600, .resend_after_steps = 4});
    std::set<std::uint64_t> at_station;
    std::uint64_t next = 0;
    std::vector<std::uint64_t> acks;
    for (std::uint64_t k = 0; k < 2000; ++k) {
      if (k < 500 && random.uniform() < 0.4) uplink.take({report(next++)});
      if (random.uniform() < 0.7) uplink.acknowledge(acks);
      acks.clear();
      for (const auto& sent : uplink.send(k, random.uniform() < 0.5)) {
        ASSERT_LT(sent.capture, next);
        ASSERT_EQ(sent.payload, report(sent.capture).payload);
        if (random.uniform() < 0.5) continue;
        at_station.insert(sent.capture);
        acks.push_back(sent.capture);
      }
    }
    EXPECT_EQ(at_station.size(), next);
    EXPECT_EQ(uplink.undelivered(), 0U);
  }
}

}  // namespace
}  // namespace skein::agent
