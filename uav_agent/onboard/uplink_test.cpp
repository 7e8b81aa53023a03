#include "uav_agent/onboard/uplink.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <set>

#include "core/math/random_stream.hpp"

namespace skein::agent {
namespace {

HandedOut report(std::uint64_t capture, std::size_t bytes = 100) { return {capture, bytes}; }

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
    for (const std::uint64_t capture : sent) {
      order.push_back(capture);
      bytes += capture == 4 ? 9000 : 100;
    }
    EXPECT_TRUE(bytes <= 250 || sent.size() == 1);
  }
  EXPECT_EQ(order, (std::vector<std::uint64_t>{2, 4, 5, 9}));
}

TEST(Uplink, IgnoresReportsThatTheCameraRepeats) {
  Uplink uplink;
  uplink.take({report(0), report(1), report(2)});
  uplink.acknowledge({0, 2});
  uplink.take({report(0), report(1), report(2), report(3)});
  EXPECT_EQ(uplink.undelivered(), 2U);
}

// For reports of any size, the uplink sends the oldest ones that are due, as many as fit, and at least one.
TEST(Uplink, EachStepSendsTheLongestPrefixThatFits) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    RandomStream random(seed, "sizes", 0);
    const Uplink::Config config{.max_bytes_per_step = 100 * (1 + random.bits() % 5), .resend_after_steps = 3};
    Uplink uplink(config);
    std::map<std::uint64_t, std::size_t> sizes;
    std::map<std::uint64_t, std::uint64_t> sent_at;
    for (std::uint64_t capture = 0; capture < 12; ++capture) {
      sizes[capture] = 50 * (1 + random.bits() % 6);
      uplink.take({report(capture, sizes[capture])});
    }
    for (std::uint64_t k = 0; k < 20; ++k) {
      std::vector<std::uint64_t> expected;
      std::size_t bytes = 0;
      for (const auto& [capture, size] : sizes) {
        if (sent_at.contains(capture) && k - sent_at[capture] < config.resend_after_steps) continue;
        if (!expected.empty() && bytes + size > config.max_bytes_per_step) break;
        bytes += size;
        expected.push_back(capture);
        sent_at[capture] = k;
      }
      ASSERT_EQ(uplink.send(k, true), expected) << "seed " << seed << " step " << k;
    }
  }
}

// In any order of acknowledgements, the uplink does not take an acknowledged report again, but takes all others.
TEST(Uplink, RemembersExactlyWhatWasAcknowledged) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    RandomStream random(seed, "acknowledged", 0);
    Uplink uplink;
    std::set<std::uint64_t> acknowledged;
    for (int i = 0; i < 40; ++i) {
      const std::uint64_t capture = random.bits() % 30;
      uplink.acknowledge({capture});
      acknowledged.insert(capture);
    }
    for (std::uint64_t capture = 0; capture <= 31; ++capture) {
      const std::size_t before = uplink.undelivered();
      uplink.take({report(capture)});
      ASSERT_EQ(uplink.undelivered() - before, acknowledged.contains(capture) ? 0U : 1U) << seed << ": " << capture;
    }
  }
}

// The last number has no successor; its range must not be joined to that of the first.
TEST(Uplink, TheLastCaptureNumberIsNotJoinedToTheFirst) {
  constexpr std::uint64_t kLast = std::numeric_limits<std::uint64_t>::max();
  Uplink uplink;
  uplink.acknowledge({0, 1, kLast});
  uplink.take({report(0), report(1), report(kLast)});
  EXPECT_EQ(uplink.undelivered(), 0U);
  uplink.take({report(2), report(kLast - 1)});
  EXPECT_EQ(uplink.undelivered(), 2U);
}

// The radio loses messages in both directions, in any order of events: all captures arrive, and nothing else.
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
      for (const std::uint64_t capture : uplink.send(k, random.uniform() < 0.5)) {
        ASSERT_LT(capture, next);
        ASSERT_TRUE(uplink.holds(capture));
        if (random.uniform() < 0.5) continue;
        at_station.insert(capture);
        acks.push_back(capture);
      }
    }
    EXPECT_EQ(at_station.size(), next);
    EXPECT_EQ(uplink.undelivered(), 0U);
    for (std::uint64_t capture = 0; capture < next; ++capture) EXPECT_FALSE(uplink.holds(capture));
  }
}

}  // namespace
}  // namespace skein::agent
