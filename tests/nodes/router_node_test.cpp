// The router between members that send messages: the links of the step in which a message is sent decide who receives
// it.
#include "comm_router/router_node.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "bus/lockstep/radio_topics.hpp"
#include "core/radio/radio_routes.hpp"
#include "idl/type_names.hpp"
#include "tests/nodes/toy_members.hpp"

namespace skein::test {
namespace {

bus::TopicSpec text_topic(const std::string& ros_topic) {
  return {wire_topic(ros_topic), type_name<msg::String>(),
          bus::Qos{.reliable = true, .latched = false, .depth = topics::radio_depth(8)}};
}

/// The server and the router of a fleet, which wait for its UAVs and for each other.
struct RoutedFleet {
  /// @param scenario  must outlive this.
  RoutedFleet(const Scenario& scenario, std::uint64_t steps)
      : server(*bus, scenario, steps), router(scenario, 0, 0, *bus) {
    server.expect_uavs(scenario);
    server.expect_router();
  }

  const std::unique_ptr<bus::Bus> bus = bus::make_bus({.vendor = "inproc"});
  ToyServer server;
  router::RouterNode router;
};

using Heard = std::map<std::uint64_t, std::vector<std::string>>;  // by step

TEST(RouterNode, EachMessageReachesTheLinkedNodesInTheNextStep) {
  constexpr std::uint64_t kSteps = 30;
  for (unsigned seed = 0; seed < 4; ++seed) {
    std::mt19937 random(seed);
    const Scenario scenario = toy_scenario(3);
    RoutedFleet fleet(scenario, kSteps);
    auto& [bus, server, router] = fleet;
    std::vector<std::unique_ptr<ToyMember>> members;
    std::map<UavIndex, Heard> heard, expected;
    std::vector<std::function<void()>> turns = {[&] { server.poll(); }, [&] { router.poll(); }};
    for (const UavIndex uav : scenario.uavs()) {
      const std::string& name = scenario.fleet[uav].name;
      ToyMember& member = *members.emplace_back(std::make_unique<ToyMember>(*bus, uav_domain(0, uav), name));
      auto now = std::make_shared<std::vector<std::string>>();
      member.client().declare_writer(text_topic("/talk"), bus::LockstepClient::Counterpart::router);
      member.client().read<msg::String>(text_topic(arrival_topic("/talk", name)),
                                        bus::LockstepClient::Counterpart::router,
                                        [now](const msg::String& text) { now->push_back(text.data()); });
      member.on_step = [&, uav, name, now](const msg::Step& step) {
        if (!now->empty()) heard[uav][step.k()] = std::exchange(*now, {});
        for (std::uint64_t n = 0; n < random() % 3; ++n) {
          msg::String text;
          text.data(name + std::to_string(step.k()) + "." + std::to_string(n));
          member.client().write(wire_topic("/talk"), text);
          for (const UavIndex other : scenario.uavs()) {
            if (other == uav || step.k() + 1 == kSteps) continue;
            if (server.links.at(node_of_uav(uav), node_of_uav(other)) != 0) {
              expected[other][step.k() + 1].push_back(text.data());
            }
          }
        }
      };
      turns.push_back([&member] { member.poll(); });
      member.start();
    }
    server.before_step = [&](std::uint64_t) {
      for (const Node from : scenario.nodes()) {
        for (const Node to : scenario.nodes()) server.links.at(from, to) = random() % 2;
      }
    };
    router.start();
    ASSERT_TRUE(take_turns(turns, [&] { return server.over(); })) << router.waiting_for();
    // Ordered by source, then by the order of sending.
    for (auto& [uav, steps] : expected) {
      for (auto& [k, texts] : steps) std::ranges::sort(texts);
    }
    EXPECT_EQ(heard, expected) << "seed " << seed;
    EXPECT_GT(router.gate().total().dropped_no_los, 0U);
    EXPECT_EQ(router.malformed(), 0U);
  }
}

TEST(RouterNode, ContinuesWithoutAMemberThatTheServerGivesUp) {
  const Scenario scenario = toy_scenario(2);
  RoutedFleet fleet(scenario, 12);
  auto& [bus, server, router] = fleet;
  ToyMember a(*bus, uav_domain(0, UavIndex{0}), "a"), b(*bus, uav_domain(0, UavIndex{1}), "b");
  for (bus::LockstepNode* node : {static_cast<bus::LockstepNode*>(&router), static_cast<bus::LockstepNode*>(&a),
                                  static_cast<bus::LockstepNode*>(&b)}) {
    node->start();
  }
  const std::vector<std::function<void()>> all = {[&] { server.poll(); }, [&] { router.poll(); }, [&] { a.poll(); },
                                                  [&] { b.poll(); }};
  ASSERT_TRUE(take_turns(all, [&] { return server.k() == 5; }));
  const std::vector<std::function<void()>> without_b = {all[0], all[1], all[2]};
  EXPECT_FALSE(take_turns(
      without_b, [&] { return server.over(); }, 200))
      << "the fleet must wait for b until the server gives it up";
  EXPECT_NE(router.waiting_for().find("b: done"), std::string::npos) << router.waiting_for();
  server.lockstep().lost("b", "given up");
  EXPECT_TRUE(take_turns(without_b, [&] { return server.over(); }));
}

/// A message is still on a slow link when its sender is lost. Then the sender's successor requests the same topic with
/// another type, which the router refuses.
TEST(RouterNode, AMessageOnASlowLinkArrivesAlthoughItsTopicIsRefusedToTheNextProgram) {
  constexpr std::uint64_t kSent = 4, kAsked = 8, kSteps = 30;
  Scenario scenario = toy_scenario(2);
  LinkEffect& slow = scenario.links.emplace_back();
  slow.latency_s = 0.5;
  slow.topics = {"/note"};
  RoutedFleet fleet(scenario, kSteps);
  auto& [bus, server, router] = fleet;
  router.set_patience(1e-9, 1.0);
  auto a = std::make_unique<ToyMember>(*bus, uav_domain(0, UavIndex{0}), "a");
  ToyMember b(*bus, uav_domain(0, UavIndex{1}), "b"), next(*bus, uav_domain(0, UavIndex{0}), "a");
  auto radio = std::make_unique<bus::RadioTopics>(a->client(), "a");
  bool sent = false, asked = false;
  a->on_step = [&](const msg::Step& step) {
    radio->begin_step();
    if (step.k() == 0) radio->send("/note", "std_msgs/msg/String", {"all"});
    if (step.k() == kSent) sent = radio->write("/note", encode(msg::String()));
  };
  const bus::TopicSpec requests = bus::spec(topics::radio_request());
  next.client().declare_writer(requests, bus::LockstepClient::Counterpart::router);
  next.on_step = [&](const msg::Step& step) {
    if (step.k() < kAsked || std::exchange(asked, true)) return;
    auto request = bus::message_of<msg::RadioRequest>(bus->run());
    request.source("a");
    request.targets({"all"});
    request.name("/note");
    request.type("std_msgs/msg/String");
    next.client().write(requests.name, request);
  };
  std::vector<std::function<void()>> turns = {[&] { server.poll(); }, [&] { router.poll(); }, [&] { b.poll(); },
                                              [&] { a->poll(); }};
  router.start();
  a->start();
  b.start();
  ASSERT_TRUE(take_turns(turns, [&] { return server.k() == kSent + 1; })) << router.waiting_for();
  EXPECT_TRUE(sent);
  server.lockstep().lost("a", "killed");
  radio.reset();
  a.reset();
  turns.back() = [&] { next.poll(); };
  next.start();
  ASSERT_TRUE(take_turns(turns, [&] { return server.over(); })) << router.waiting_for();
  EXPECT_TRUE(asked);
  EXPECT_EQ(router.gate().total().sent, 2U) << "the message is sent to b and gcs";
  EXPECT_EQ(router.gate().total().delivered, 2U);
}

/// A request for another type than the topic's is refused. The program that made it may ask again for the right one,
/// and the fleet does not wait for a writer of the wrong one.
TEST(RouterNode, AMemberThatAskedForTheWrongTypeOfATopicMayCorrectIt) {
  constexpr std::uint64_t kWrong = 3, kRight = 8, kSays = 14, kSteps = 20;
  const std::string right = "std_msgs/msg/String", wrong = "std_msgs/msg/Bool";
  const Scenario scenario = toy_scenario(3);
  RoutedFleet fleet(scenario, kSteps);
  auto& [bus, server, router] = fleet;
  router.set_patience(1e-9, 1.0);
  ToyMember first(*bus, uav_domain(0, UavIndex{0}), "a"), sender(*bus, uav_domain(0, UavIndex{1}), "b"),
      listener(*bus, uav_domain(0, UavIndex{2}), "c");
  bus::RadioTopics of_first(first.client(), "a"), of_sender(sender.client(), "b"), of_listener(listener.client(), "c");
  bool sent = false;
  int heard = 0, misheard = 0;
  first.on_step = [&](const msg::Step& step) {
    of_first.begin_step();
    if (step.k() == 0) of_first.send("/note", right, {"all"});
  };
  sender.on_step = [&](const msg::Step& step) {
    of_sender.begin_step();
    if (step.k() == kWrong) of_sender.send("/note", wrong, {"all"});
    if (step.k() == kSays) sent = of_sender.write("/note", encode(msg::String()));
    if (step.k() != kRight) return;
    EXPECT_NE(of_sender.sending("/note").refusal, "");
    of_sender.send("/note", right, {"all"});
  };
  listener.on_step = [&](const msg::Step& step) {
    of_listener.begin_step();
    if (step.k() == kWrong) of_listener.listen("/note", wrong, [&](bus::Sample&&) { ++misheard; });
    if (step.k() != kRight) return;
    EXPECT_NE(of_listener.listening("/note").refusal, "");
    of_listener.listen("/note", right, [&](bus::Sample&&) { ++heard; });
  };
  std::vector<std::function<void()>> turns = {[&] { server.poll(); }, [&] { router.poll(); }};
  router.start();
  for (ToyMember* const member : {&first, &sender, &listener}) {
    member->start();
    turns.push_back([member] { member->poll(); });
  }
  ASSERT_TRUE(take_turns(turns, [&] { return server.over(); })) << router.waiting_for();
  EXPECT_TRUE(sent) << of_sender.sending("/note").refusal;
  EXPECT_EQ(heard, 1) << of_listener.listening("/note").refusal;
  EXPECT_EQ(misheard, 0);
}

TEST(RouterNode, NamesTheMemberForWhichItWaitsBeforeItsRadioIsOpen) {
  const Scenario scenario = toy_scenario(1);
  const auto bus = bus::make_bus({.vendor = "inproc"});
  ToyServer server(*bus, scenario, 3);
  server.expect_uavs(scenario);  // the server does not expect the router, which therefore cannot join
  router::RouterNode router(scenario, 0, 0, *bus);
  ToyMember a(*bus, uav_domain(0, UavIndex{0}), "a");
  router.start();
  a.start();
  const std::vector<std::function<void()>> all = {[&] { server.poll(); }, [&] { a.poll(); }, [&] { router.poll(); }};
  EXPECT_TRUE(take_turns(all, [&] { return server.over(); })) << router.waiting_for();
  EXPECT_NE(router.waiting_for().find("a: the radio to open"), std::string::npos) << router.waiting_for();
}

}  // namespace
}  // namespace skein::test
