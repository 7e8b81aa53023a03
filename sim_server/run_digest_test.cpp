#include "sim_server/run_digest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace skein::sim {
namespace {

const std::vector<std::string> kNames = {"a", "b"};

/// One exchange; owns the data that the input refers to.
struct Exchange {
  DigestInput input;
  std::vector<LedgerEntry> ledger;
  std::vector<std::uint8_t> radio, tally;

  Exchange() {
    input.k = 7;
    input.uavs.resize(2);
    input.uavs[0].state.p_WB = {1, 2, 3};
    ledger.push_back({.index = 0, .tick = 100, .uav = UavIndex{1}, .collision = false, .capture = {}});
    ledger[0].capture.points = {{.index = 5}, {.index = 6}};
    radio = {1, 2, 3};
  }
  StepDigest hashed(std::string* all = nullptr) {
    input.ledger = ledger;
    input.radio = radio;
    input.tally = tally;
    RunDigest digest(kNames);
    StepDigest step = digest.add(input);
    if (all) *all = digest.hex();
    return step;
  }
};

TEST(RunDigest, TheDigestNamesItsColumns) {
  const RunDigest digest(kNames);
  ASSERT_EQ(digest.columns().size(), 15U);
  EXPECT_EQ(digest.columns()[0], "a.position");
  EXPECT_EQ(digest.columns()[11], "b.alive");
  EXPECT_EQ(digest.columns()[14], "tally");
}

TEST(RunDigest, EveryFieldCountsAndIsReported) {
  const StepDigest base = Exchange().hashed();
  const RunDigest names(kNames);
  const std::vector<std::pair<std::string, std::function<void(Exchange&)>>> changes = {
      {"a.position", [](Exchange& e) { e.input.uavs[0].state.p_WB.z() += 1e-12; }},
      {"b.attitude", [](Exchange& e) { e.input.uavs[1].state.q_WB.x() = 1e-9; }},
      {"b.velocity", [](Exchange& e) { e.input.uavs[1].state.v_WB.x() = 1e-9; }},
      {"a.body_rates", [](Exchange& e) { e.input.uavs[0].state.w_WB_B.y() = 1e-9; }},
      {"a.gimbal", [](Exchange& e) { e.input.uavs[0].gimbal.yaw = 1e-9; }},
      {"b.alive", [](Exchange& e) { e.input.uavs[1].alive = false; }},
      {"ledger", [](Exchange& e) { e.ledger[0].capture.points[1].index = 9; }},
      {"ledger", [](Exchange& e) { e.ledger[0].tick = 101; }},
      {"radio", [](Exchange& e) { e.radio[2] = 4; }},
      {"tally", [](Exchange& e) { e.tally = {0}; }},
  };
  for (const auto& [field, change] : changes) {
    Exchange changed;
    change(changed);
    const StepDigest step = changed.hashed();
    EXPECT_NE(step.running, base.running) << field;
    for (std::size_t i = 0; i < step.fields.size(); ++i) {
      EXPECT_EQ(step.fields[i] == base.fields[i], names.columns()[i] != field) << field << ", " << names.columns()[i];
    }
  }
}

TEST(RunDigest, TokensAndGimbalRatesDoNotEnterTheDigest) {
  const StepDigest base = Exchange().hashed();
  Exchange changed;
  changed.ledger[0].capture.token = 99;
  changed.input.uavs[0].gimbal.yaw_rate = 1.0;
  EXPECT_EQ(changed.hashed().running, base.running);
}

TEST(RunDigest, TheRunningDigestDependsOnAllSteps) {
  Exchange exchange;
  std::string all;
  const StepDigest first = exchange.hashed(&all);
  EXPECT_EQ(all, first.running);
  EXPECT_EQ(all.size(), 64U);
  RunDigest digest(kNames);
  digest.add(exchange.input);
  const StepDigest second = digest.add(exchange.input);
  EXPECT_EQ(second.fields, first.fields);
  EXPECT_NE(second.running, first.running);
}

TEST(RunDigest, AFleetOfAnotherSizeIsRefused) {
  RunDigest digest(kNames);
  EXPECT_THROW(digest.add({}), std::logic_error);
}

}  // namespace
}  // namespace skein::sim
