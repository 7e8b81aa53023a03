#include "uav_agent/client/relay.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "idl/cdr.hpp"

namespace skein::agent {
namespace {

constexpr double kExchange_s = 0.05;

Relay::Payload trajectory(double stamp_s, double x = 0.0) {
  msg::MultiDOFJointTrajectory message;
  message.header().stamp().sec(static_cast<int>(stamp_s));
  message.header().stamp().nanosec(static_cast<unsigned>(1e9 * (stamp_s - static_cast<int>(stamp_s)) + 0.5));
  message.points().resize(1);
  message.points()[0].transforms().resize(1);
  message.points()[0].transforms()[0].translation().x(x);
  return encode(message);
}

Relay relay_of(const topics::WireTopic& topic) { return {topic, kExchange_s}; }

// Draws sequences of actions of nodes and of the fleet. The relay counts each message that arrives once, as handed on,
// refused or lost, and passes on the newest messages in their order.
TEST(Relay, CountsEverySampleOnce) {
  std::mt19937 random(38);
  for (int repeat = 0; repeat < 200; ++repeat) {
    Relay relay = relay_of(topics::trajectory_command("jurong"));
    const auto depth = static_cast<std::size_t>(relay.topic().depth);
    std::uint64_t said = 0, malformed = 0, handed_on = 0, lost = 0;
    std::vector<Relay::Payload> waiting;
    for (int event = 0; event < 30; ++event) {
      const unsigned kind = random() % 8;
      if (kind == 0) {
        lost += waiting.size();
        waiting.clear();
        relay.forget();
      } else if (kind < 4) {
        EXPECT_EQ(relay.take(1.0), waiting);
        handed_on += waiting.size();
        waiting.clear();
      } else {
        for (unsigned i = random() % (2 * depth); i > 0; --i) {
          Relay::Payload sample = trajectory(1.0, static_cast<double>(said));
          ++said;
          if (random() % 5 == 0) {
            sample.resize(random() % 40);
            ++malformed;
            relay.hear(sample);
            continue;
          }
          relay.hear(sample);
          waiting.push_back(sample);
        }
        if (waiting.size() > depth) {
          lost += waiting.size() - depth;
          waiting.erase(waiting.begin(), waiting.end() - static_cast<std::ptrdiff_t>(depth));
        }
      }
    }
    const RelayedTopic report = relay.report();
    EXPECT_EQ(report.topic, "/jurong/command/trajectory");
    EXPECT_EQ(report.received, said);
    EXPECT_EQ(report.handed_on, handed_on);
    EXPECT_EQ(report.refused, malformed);
    EXPECT_EQ(report.lost, lost + waiting.size()) << "samples that still wait reach no step";
    EXPECT_EQ(report.late, 0U);
    EXPECT_EQ(report.other_clock, 0U);
  }
}

TEST(Relay, CountsSamplesAsLateThatAreOlderThanTwoExchanges) {
  Relay relay = relay_of(topics::trajectory_command("jurong"));
  for (const double age_s : {0.0, 0.05, 0.1, 0.15, 3.0}) relay.hear(trajectory(100.0 - age_s));
  relay.hear(trajectory(0.0));  // a node that stamps nothing
  EXPECT_EQ(relay.take(100.0).size(), 6U);
  EXPECT_EQ(relay.report().late, 2U);
  EXPECT_EQ(relay.report().other_clock, 0U);
  relay.hear(trajectory(1.7e9));
  relay.take(100.0);
  EXPECT_EQ(relay.report().late, 2U);
  EXPECT_EQ(relay.report().other_clock, 1U);
}

TEST(Relay, CountsWhatTheServerRejects) {
  Relay relay = relay_of(topics::gimbal_command("jurong"));
  relay.hear(encode(msg::Twist()));
  relay.take(1.0);
  relay.reject();
  EXPECT_EQ(relay.report().handed_on, 1U);
  EXPECT_EQ(relay.report().refused, 1U);
}

TEST(Relay, HandsOnTypesThatItDoesNotKnow) {
  Relay relay = relay_of({"rt/plan", "their_msgs::msg::dds_::Plan_", false, 4});
  const Relay::Payload sample = {0, 1, 0, 0, 42};
  relay.hear(sample);
  EXPECT_EQ(relay.take(1.0), std::vector<Relay::Payload>{sample});
}

}  // namespace
}  // namespace skein::agent
