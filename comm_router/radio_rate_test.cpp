// Rates of links under path loss: the server tells each link's level, and messages queue at the rate of that level.
#include <gtest/gtest.h>

#include <cmath>

#include "comm_router/link_stages.hpp"

namespace skein::router {
namespace {

constexpr Node kFrom = Node{1}, kTo = Node{2};
const RadioRoute kWay{kFrom, "/x", "std_msgs/msg/String", "rt/x", "std_msgs::msg::dds_::String_", {{kTo, "rt/x/b"}}};

Scenario with_radio(double rate_share) {
  Scenario scenario;
  for (const char* name : {"a", "b"}) scenario.fleet.push_back({.name = name, .vehicle = {}});
  scenario.conditions.radio.exponent = 2.5;
  scenario.conditions.radio.rate_share = rate_share;
  return scenario;
}

SentMessage of(std::uint64_t sequence, std::size_t bytes) {
  return {0, sequence, std::make_shared<const std::vector<std::uint8_t>>(bytes)};
}

TEST(RadioRate, AMessageTakesAsLongAsItsLinksRateSays) {
  const Scenario scenario = with_radio(0.01);
  for (std::uint8_t level = 1; level <= kRadioRates.size(); ++level) {
    LinkStages stages(scenario, {}, 1);
    Links links(3);
    links.at(kFrom, kTo) = level;
    stages.begin_step(links);
    constexpr std::size_t kBytes = 30'000;
    const double time_s = 8.0 * kBytes / (0.01 * kRadioRates[level - 1U].rate_bit_s);
    const LinkFate fate = stages.fate(0, kWay, kTo, of(0, kBytes));
    EXPECT_EQ(fate.loss, LinkLoss::none);
    EXPECT_EQ(fate.delay_steps, static_cast<std::uint64_t>(std::ceil(time_s / 0.05 - 1e-9))) << int{level};
  }
}

TEST(RadioRate, AFullQueueLosesMessagesAndLeavesTheOtherDirectionFree) {
  const Scenario scenario = with_radio(0.001);
  LinkStages stages(scenario, {}, 1);
  Links links(3, std::uint8_t{1});
  stages.begin_step(links);
  EXPECT_EQ(stages.fate(0, kWay, kTo, of(0, 60'000)).loss, LinkLoss::none);
  EXPECT_EQ(stages.fate(0, kWay, kTo, of(1, 60'000)).loss, LinkLoss::overflow);
  RadioRoute back = kWay;
  back.source = kTo;
  EXPECT_EQ(stages.fate(0, back, kFrom, of(0, 60'000)).loss, LinkLoss::none);
}

// A program that was killed receives nothing, but its UAV hovers on in sight, so messages to it still pass its link.
TEST(RadioRate, MessagesToOneReceiverDoNotDelayThoseToOthers) {
  constexpr Node kOther = Node{3};
  for (const bool path_loss : {true, false}) {
    Scenario scenario = with_radio(0.001);
    scenario.fleet.push_back({.name = "c", .vehicle = {}});
    if (!path_loss) {
      scenario.conditions.radio.exponent.reset();
      scenario.links.emplace_back().bandwidth_bit_s = 1e5;
    }
    LinkStages busy(scenario, {}, 1), idle(scenario, {}, 1);
    for (LinkStages* stages : {&busy, &idle}) stages->begin_step(Links(4, std::uint8_t{1}));
    std::size_t overflows = 0;
    for (std::uint64_t k = 0; k < 40; ++k) {
      for (std::uint64_t n = 0; n < 3; ++n) {
        overflows += busy.fate(k, kWay, kTo, of(3 * k + n, 4'000)).loss == LinkLoss::overflow;
      }
      const LinkFate beside = busy.fate(k, kWay, kOther, of(k, 400)), alone = idle.fate(k, kWay, kOther, of(k, 400));
      EXPECT_EQ(beside.loss, LinkLoss::none);
      EXPECT_EQ(beside.delay_steps, alone.delay_steps) << k;
    }
    EXPECT_GT(overflows, 20U) << "the link to the first receiver is full";
  }
}

TEST(RadioRate, WithoutPathLossALinkIsIdeal) {
  Scenario scenario = with_radio(0.001);
  scenario.conditions.radio.exponent.reset();
  LinkStages stages(scenario, {}, 1);
  stages.begin_step(Links(3, std::uint8_t{1}));
  EXPECT_EQ(stages.fate(0, kWay, kTo, of(0, 1'000'000)).delay_steps, 0U);
}

}  // namespace
}  // namespace skein::router
