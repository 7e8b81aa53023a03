// The lock-step protocol with random orders of events: no deadlock, no divergence.
// SKEIN_LONG=1 draws many more.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <set>

#include "bus/lockstep/names.hpp"
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
    ASSERT_GT(messages, 10U) << "the fleet sends too few messages for this test";
    for (std::uint64_t seed = 1; seed < schedules(40); ++seed) {
      FleetModel model({.uavs = uavs}, seed);
      ASSERT_EQ(model.run(), "") << "schedule " << seed;
      ASSERT_TRUE(model.lost().empty());
      ASSERT_NO_FATAL_FAILURE(expect_same(first, model, seed));
    }
  }
}

TEST(Protocol, MembersOfAnotherRunDoNotChangeTheRun) {
  FleetModel alone({.uavs = 2}, 0);
  ASSERT_EQ(alone.run(), "");
  for (std::uint64_t seed = 0; seed < schedules(20); ++seed) {
    FleetModel model({.uavs = 2, .leftovers = true}, seed);
    ASSERT_EQ(model.run(), "") << "schedule " << seed;
    ASSERT_TRUE(model.lost().empty());
    ASSERT_NO_FATAL_FAILURE(expect_same(alone, model, seed));
  }
}

/// Expects that the server gave up exactly the member for which all wait, and that the others reached the last step.
void expect_only_a_given_up(const FleetModel& model, const std::string& what, std::uint64_t steps) {
  ASSERT_EQ(model.given_up(), std::vector<std::string>{"a: " + what});
  ASSERT_EQ(model.lost(), std::vector<std::string>{"a"});
  for (const std::string name : {"b", "station"}) ASSERT_EQ(model.agents().at(name).back().k, steps - 1) << name;
}

TEST(Protocol, AfterARouterReturnsAMemberWithoutItsTopicIsGivenUp) {
  for (std::uint64_t seed = 0; seed < schedules(40); ++seed) {
    const ProcessFault fault{.victim = std::string(bus::kRouterName), .kill = seed % 2 == 0, .begin = 3, .end = 6};
    FleetModel model({.uavs = 2, .steps = 10, .fault = fault, .closes_writer = 4 + seed % 2, .gives_up = true}, seed);
    ASSERT_EQ(model.run(), "") << "schedule " << seed;
    ASSERT_NO_FATAL_FAILURE(expect_only_a_given_up(model, "rt/talk to match", 10)) << "schedule " << seed;
  }
}

TEST(Protocol, AMemberThatAnnouncesMoreThanItSendsIsGivenUpNotTheRouter) {
  for (std::uint64_t seed = 0; seed < schedules(40); ++seed) {
    const std::uint64_t k = 1 + seed % 6;
    FleetModel model({.uavs = 2, .steps = 10, .announces_too_much = k, .gives_up = true}, seed);
    ASSERT_EQ(model.run(), "") << "schedule " << seed;
    ASSERT_EQ(model.given_up().size(), 1U) << "schedule " << seed;
    const std::string what = model.given_up()[0].substr(std::min<std::size_t>(3, model.given_up()[0].size()));
    ASSERT_TRUE(what.starts_with("rt/talk ")) << model.given_up()[0];
    ASSERT_NO_FATAL_FAILURE(expect_only_a_given_up(model, what, 10)) << "schedule " << seed;
  }
}

struct Lost {
  const char* what;
  int domain;
  std::string topic;
};

class LostOnItsWay : public testing::TestWithParam<Lost> {};

TEST_P(LostOnItsWay, IsRequestedAgainAndTheRunIsTheSame) {
  FleetModel usual({.uavs = 2}, 0);
  ASSERT_EQ(usual.run(), "");
  for (std::uint64_t seed = 0; seed < schedules(20); ++seed) {
    FleetOptions options;
    options.loses = {1 + seed % 6, GetParam().domain, GetParam().topic};
    options.asks_again = true;
    FleetModel model(options, seed);
    ASSERT_EQ(model.run(), "") << "schedule " << seed;
    ASSERT_TRUE(model.lost().empty());
    ASSERT_NO_FATAL_FAILURE(expect_same(usual, model, seed));
  }
}

INSTANTIATE_TEST_SUITE_P(All, LostOnItsWay,
                         testing::Values(Lost{"StepToAnAgent", uav_domain(0, UavIndex{0}), topics::step().name},
                                         Lost{"StepToTheRouter", world_domain(0), topics::step().name},
                                         Lost{"DoneOfAnAgent", uav_domain(0, UavIndex{1}), topics::done().name},
                                         Lost{"DoneOfTheStation", gcs_domain(0), topics::station_done().name},
                                         Lost{"Routed", world_domain(0), topics::routed().name}),
                         [](const auto& lost) { return lost.param.what; });

std::uint64_t step_of(const std::string& said) { return std::stoull(said.substr(said.find('@') + 1)); }

/// Expects each node to have received exactly the messages on registered topics that were sent to it over an open link.
void expect_heard_over_open_links(const FleetModel& model, const std::vector<std::string>& nodes) {
  std::size_t heard = 0;
  for (std::size_t from = 0; from < nodes.size(); ++from) {
    for (const StepLog& step : model.agents().at(nodes[from])) {
      for (std::size_t to = 0; to < nodes.size(); ++to) {
        const auto& steps = model.agents().at(nodes[to]);
        if (step.k + 1 >= steps.size()) continue;
        const bool expected = linked_in_model(from, to, step.k) && steps[step.k].listening;
        for (const std::string& said : step.said) {
          if (said.find("chat") == std::string::npos) continue;
          const auto count = std::ranges::count(steps[step.k + 1].heard, said);
          ASSERT_EQ(count, expected ? 1 : 0) << said << " at " << nodes[to];
          heard += static_cast<std::size_t>(count);
        }
      }
    }
  }
  EXPECT_GT(heard, 5U);
}

TEST(Protocol, RegisteredTopicsCarryEveryMessage) {
  for (std::uint64_t seed = 0; seed < schedules(20); ++seed) {
    FleetModel model({.uavs = 3}, seed);
    ASSERT_EQ(model.run(), "") << "schedule " << seed;
    ASSERT_NO_FATAL_FAILURE(expect_heard_over_open_links(model, {"station", "a", "b", "c"}));
  }
}

/// Expects a member to have received, from its first step on, all samples of a latched topic: those in the topic's
/// history when it joined, and all later ones.
void expect_latched_known(const std::string& life, const std::vector<StepLog>& steps, std::uint64_t seed) {
  if (steps.empty() || life.starts_with(bus::kStationName)) return;
  std::vector<std::string> expected, heard;
  for (std::uint64_t k = 0; k <= steps.back().k; ++k) {
    if (k == steps.front().k && expected.size() > 2) expected.erase(expected.begin(), expected.end() - 2);
    if (tells_site_in_model(k)) expected.push_back("site" + std::to_string(k));
  }
  for (const StepLog& step : steps) {
    std::ranges::copy_if(step.heard, std::back_inserter(heard),
                         [](const auto& text) { return text.starts_with("site"); });
  }
  ASSERT_EQ(heard, expected) << life << " schedule " << seed;
}

/// Invariants of every run, whichever program dies: steps without gaps; a radio message is received unchanged, once,
/// one step after it was sent; a command is accepted once, in the step in which it was sent, in order.
void check_invariants(const FleetModel& model, const std::string& victim, std::uint64_t seed) {
  std::set<std::string> said;
  for (const auto& [life, steps] : model.agents()) {
    for (const StepLog& step : steps) said.insert(step.said.begin(), step.said.end());
  }
  for (const auto& [life, steps] : model.agents()) {
    ASSERT_NO_FATAL_FAILURE(expect_latched_known(life, steps, seed));
    std::set<std::string> heard;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      ASSERT_EQ(steps[i].k, steps[0].k + i) << life << " schedule " << seed;
      for (const std::string& text : steps[i].heard) {
        if (text.find('@') == std::string::npos) continue;  // a sensor
        ASSERT_TRUE(heard.insert(text).second) << life << " heard twice: " << text << " schedule " << seed;
        ASSERT_EQ(step_of(text) + 1, steps[i].k) << life << " schedule " << seed;
        // The victim may have died between sending the message and logging it.
        ASSERT_TRUE(text.starts_with(victim) || said.contains(text)) << text;
      }
    }
    const std::string uav = life.substr(0, life.find('#'));
    const auto taken = model.taken().find(uav);
    for (const StepLog& step : steps) {
      std::vector<std::string> of_step;
      if (taken != model.taken().end() && taken->second.contains(step.k)) of_step = taken->second.at(step.k);
      if (uav == victim && of_step.empty()) continue;  // commands of a victim may be discarded
      ASSERT_EQ(of_step, step.commanded) << life << " step " << step.k << " schedule " << seed;
    }
  }
}

struct Loss {
  const char* victim;
  bool restart;
};

class ProtocolLoss : public testing::TestWithParam<Loss> {};

TEST_P(ProtocolLoss, TheOtherMembersContinueAndTheLostOneMayComeBack) {
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

/// Checks a member's absence by a fault: it takes no steps and sends nothing, the others miss no step; without the
/// router, no radio message arrives.
void check_absence(const FleetModel& model, const ProcessFault& fault, std::uint64_t seed) {
  const auto out = [&](std::uint64_t k) { return k >= fault.begin && k < fault.end; };
  std::map<std::string, std::set<std::uint64_t>> steps;
  for (const auto& [life, logs] : model.agents()) {
    // A paused member continues with the same log, and receives latched samples again.
    if (fault.kill) {
      ASSERT_NO_FATAL_FAILURE(expect_latched_known(life, logs, seed));
    }
    for (const StepLog& log : logs) {
      steps[life.substr(0, life.find('#'))].insert(log.k);
      const bool deaf = fault.victim == bus::kRouterName && (out(log.k) || log.k == fault.end);
      for (const std::string& text : log.heard) {
        if (text.find('@') == std::string::npos) continue;  // a sensor
        ASSERT_FALSE(deaf) << life << " heard " << text << " in step " << log.k << " schedule " << seed;
        ASSERT_EQ(step_of(text) + 1, log.k) << life << " schedule " << seed;
      }
    }
  }
  for (const std::string name : {"a", "b", "station"}) {
    for (std::uint64_t k = 0; k < 9; ++k) {
      ASSERT_EQ(steps[name].contains(k), name != fault.victim || !out(k)) << name << " step " << k;
    }
  }
}

struct Fault {
  const char* victim;
  bool kill;
};

class ScriptedFault : public testing::TestWithParam<Fault> {};

TEST_P(ScriptedFault, EveryOrderOfEventsGivesTheSameRun) {
  const std::string victim = GetParam().victim;
  const bool kill = GetParam().kill;
  for (const auto& [begin, end] : {std::pair{3, 6}, std::pair{0, 1}, std::pair{5, 1000}}) {
    std::unique_ptr<FleetModel> first;
    for (std::uint64_t seed = 0; seed < schedules(40); ++seed) {
      const ProcessFault fault{.victim = victim,
                               .kill = kill,
                               .begin = static_cast<std::uint64_t>(begin),
                               .end = static_cast<std::uint64_t>(end),
                               .returns_early = seed % 2 == 1};
      auto model = std::make_unique<FleetModel>(FleetOptions{.uavs = 2, .steps = 9, .fault = fault}, seed);
      ASSERT_EQ(model->run(), "") << victim << " schedule " << seed;
      ASSERT_TRUE(model->lost().empty()) << "a member that a fault takes out counts as lost; schedule " << seed;
      ASSERT_EQ(model->rejoined().size(), end < 9 ? 1U : 0U) << "schedule " << seed;
      ASSERT_NO_FATAL_FAILURE(check_absence(*model, fault, seed));
      if (first) {
        ASSERT_NO_FATAL_FAILURE(expect_same(*first, *model, seed));
      }
      if (!first) first = std::move(model);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, ScriptedFault,
                         testing::Values(Fault{"a", true}, Fault{"a", false}, Fault{"station", true},
                                         Fault{"station", false}, Fault{"comm_router", true},
                                         Fault{"comm_router", false}),
                         [](const auto& fault) {
                           return std::string(fault.param.victim) + (fault.param.kill ? "Killed" : "Stopped");
                         });

/// Delays discovery, or a link, more than everything else. This reveals code that relies on fast arrivals.
TEST(Protocol, ASlowLinkOrDiscoveryChangesNothing) {
  FleetModel first({.uavs = 2}, 0);
  ASSERT_EQ(first.run(), "");
  for (std::uint64_t seed = 1; seed < schedules(120); ++seed) {
    FleetModel model({.uavs = 2, .slow = seed}, seed);
    ASSERT_EQ(model.run(), "") << "schedule " << seed;
    ASSERT_TRUE(model.lost().empty());
    ASSERT_NO_FATAL_FAILURE(expect_same(first, model, seed));
  }
}

TEST_P(ProtocolLoss, ASlowLinkOrDiscoveryChangesNothing) {
  const std::string victim = GetParam().victim;
  for (std::uint64_t seed = 0; seed < schedules(60); ++seed) {
    const FleetOptions options{
        .uavs = 2, .victim = victim, .restart = GetParam().restart, .kill_after = 20 * (seed % 60), .slow = seed};
    FleetModel model(options, seed);
    ASSERT_EQ(model.run(), "") << victim << " schedule " << seed;
    ASSERT_NO_FATAL_FAILURE(check_invariants(model, victim, seed));
  }
}

TEST_P(ScriptedFault, ASlowLinkOrDiscoveryChangesNothing) {
  std::unique_ptr<FleetModel> first;
  for (std::uint64_t seed = 0; seed < schedules(40); ++seed) {
    const ProcessFault fault{
        .victim = GetParam().victim, .kill = GetParam().kill, .begin = 3, .end = 6, .returns_early = seed % 2 == 1};
    const auto slow = seed == 0 ? std::nullopt : std::optional(seed);
    auto model = std::make_unique<FleetModel>(FleetOptions{.uavs = 2, .steps = 9, .fault = fault, .slow = slow}, seed);
    ASSERT_EQ(model->run(), "") << GetParam().victim << " schedule " << seed;
    ASSERT_NO_FATAL_FAILURE(check_absence(*model, fault, seed));
    if (first) {
      ASSERT_NO_FATAL_FAILURE(expect_same(*first, *model, seed));
    }
    if (!first) first = std::move(model);
  }
}

}  // namespace
}  // namespace skein::test
