// The lock-step protocol under every order of events that a seed draws: no deadlock, no divergence.
// SKEIN_LONG=1 draws many more.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>

#include "tests/protocol/fleet_model.hpp"

namespace skein::test {
namespace {

std::uint64_t schedules(std::uint64_t count) { return std::getenv("SKEIN_LONG") ? 20 * count : count; }

bool operator_equal(const StepLog& a, const StepLog& b) {
  return a.k == b.k && a.heard == b.heard && a.said == b.said && a.commanded == b.commanded;
}

void expect_same(const FleetModel& a, const FleetModel& b, std::uint64_t seed) {
  ASSERT_EQ(a.taken(), b.taken()) << "schedule " << seed;
  ASSERT_EQ(a.agents().size(), b.agents().size());
  for (const auto& [name, steps] : a.agents()) {
    const auto& other = b.agents().at(name);
    ASSERT_EQ(steps.size(), other.size()) << name;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      ASSERT_TRUE(operator_equal(steps[i], other[i])) << name << " step " << steps[i].k << " schedule " << seed;
    }
  }
}

TEST(Protocol, EveryOrderOfArrivalGivesTheSameRun) {
  for (const std::size_t uavs : {1U, 2U, 4U}) {
    FleetModel first({.uavs = uavs}, 0);
    ASSERT_EQ(first.run(), "");
    std::size_t messages = 0;
    for (const auto& [name, steps] : first.agents()) {
      for (const StepLog& step : steps) messages += step.heard.size();
    }
    ASSERT_GT(messages, 10U) << "the fleet must have something to say";
    for (std::uint64_t seed = 1; seed < schedules(40); ++seed) {
      FleetModel model({.uavs = uavs}, seed);
      ASSERT_EQ(model.run(), "") << "schedule " << seed;
      ASSERT_TRUE(model.lost().empty());
      ASSERT_NO_FATAL_FAILURE(expect_same(first, model, seed));
    }
  }
}

std::uint64_t step_of(const std::string& said) { return std::stoull(said.substr(said.find('@') + 1)); }

/// What must hold in every run, whoever dies: steps without gaps; a radio message is heard one step after it was
/// said, once, as it was said; a command is taken once, in the step of its sender, in order.
void check_invariants(const FleetModel& model, const std::string& victim, std::uint64_t seed) {
  std::set<std::string> said;
  for (const auto& [life, steps] : model.agents()) {
    for (const StepLog& step : steps) said.insert(step.said.begin(), step.said.end());
  }
  for (const auto& [life, steps] : model.agents()) {
    std::set<std::string> heard;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      ASSERT_EQ(steps[i].k, steps[0].k + i) << life << " schedule " << seed;
      for (const std::string& text : steps[i].heard) {
        if (text.find('@') == std::string::npos) continue;  // a sensor
        ASSERT_TRUE(heard.insert(text).second) << life << " heard twice: " << text << " schedule " << seed;
        ASSERT_EQ(step_of(text) + 1, steps[i].k) << life << " schedule " << seed;
        // The dead may have spoken without living to log it.
        ASSERT_TRUE(text.starts_with(victim) || said.contains(text)) << text;
      }
    }
    const std::string uav = life.substr(0, life.find('#'));
    const auto taken = model.taken().find(uav);
    for (const StepLog& step : steps) {
      std::vector<std::string> of_step;
      if (taken != model.taken().end() && taken->second.contains(step.k)) of_step = taken->second.at(step.k);
      if (uav == victim && of_step.empty()) continue;  // discarded with its sender
      ASSERT_EQ(of_step, step.commanded) << life << " step " << step.k << " schedule " << seed;
    }
  }
}

struct Loss {
  const char* victim;
  bool restart;
};

class ProtocolLoss : public testing::TestWithParam<Loss> {};

TEST_P(ProtocolLoss, TheOthersGoOnAndTheLostOneMayComeBack) {
  const std::string victim = GetParam().victim;
  std::size_t lost = 0, rejoined = 0;
  for (std::uint64_t seed = 0; seed < schedules(120); ++seed) {
    const FleetOptions options{
        .uavs = 2, .steps = 8, .victim = victim, .restart = GetParam().restart, .kill_after = 20 * (seed % 60)};
    FleetModel model(options, seed);
    ASSERT_EQ(model.run(), "") << victim << " schedule " << seed;
    ASSERT_NO_FATAL_FAILURE(check_invariants(model, victim, seed));
    for (const std::string name : {"a", "b", "station"}) {
      if (name == victim) continue;
      ASSERT_EQ(model.agents().at(name).back().k, options.steps - 1) << name << " schedule " << seed;
    }
    lost += !model.lost().empty();
    rejoined += !model.rejoined().empty();
  }
  EXPECT_GT(lost, 20U);
  EXPECT_TRUE(!GetParam().restart || rejoined > 10U) << rejoined;
}

INSTANTIATE_TEST_SUITE_P(All, ProtocolLoss,
                         testing::Values(Loss{"a", false}, Loss{"a", true}, Loss{"station", false},
                                         Loss{"station", true}, Loss{"comm_router", false}, Loss{"comm_router", true}),
                         [](const auto& loss) {
                           return std::string(loss.param.victim) + (loss.param.restart ? "Restarts" : "Dies");
                         });

}  // namespace
}  // namespace skein::test
