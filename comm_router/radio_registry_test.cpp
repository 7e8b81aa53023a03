// Tests registrations with simulated DDS endpoints: the test decides which of them match, and when.
#include "comm_router/radio_registry.hpp"

#include <gtest/gtest.h>

#include <set>

namespace skein::router {
namespace {

constexpr SourceId kFirst = 11, kSecond = 12, kStation = 10;
const std::string kType = "some/msg/Type", kOtherType = "other/msg/Type";

class Registry : public testing::Test {
 protected:
  static Scenario three_nodes() {
    Scenario scenario;
    for (const char* name : {"a", "b"}) {
      UavConfig uav;
      uav.name = name;
      scenario.fleet.push_back(uav);
    }
    return scenario;
  }

  static RadioRequest sending(SourceId source, std::uint32_t id, std::vector<std::string> targets = {"all"},
                              const std::string& type = kType) {
    return {.asker = {source, node(source), id},
            .listen = false,
            .source = three_nodes().node_name(node(source)),
            .targets = std::move(targets),
            .name = "/x",
            .type = type};
  }
  static RadioRequest listening(SourceId source, std::uint32_t id, const std::string& type = kType) {
    return {
        .asker = {source, node(source), id}, .listen = true, .source = "", .targets = {}, .name = "/x", .type = type};
  }
  static Node node(SourceId source) { return Node(source - kStation); }

  std::vector<RadioReply> step(const std::vector<RadioRequest>& requests = {}) {
    registry_.begin_step(requests);
    return registry_.end_step();
  }

  const Scenario scenario_ = three_nodes();
  RadioTable table_{scenario_};
  std::set<std::size_t> opened_;
  std::set<SourceId> hears_{kFirst, kSecond, kStation}, reaches_{kFirst, kSecond, kStation}, admitted_, lost_;
  std::set<Node> declared_;
  RadioRegistry registry_{scenario_,
                          table_,
                          {.open = [this](std::size_t route) { opened_.insert(route); },
                           .close = [this](std::size_t route) { opened_.erase(route); },
                           .hears = [this](std::size_t, SourceId source) { return hears_.contains(source); },
                           .reaches = [this](const RadioTarget&, SourceId who) { return reaches_.contains(who); },
                           .declared = [this](const RadioTarget& target) { return declared_.contains(target.node); },
                           .admit = [this](std::size_t, SourceId source) { admitted_.insert(source); },
                           .lost = [this](SourceId source) { return lost_.contains(source); }}};
};

TEST_F(Registry, ATopicOpensOnceTheRouterHasMatchedTheWriter) {
  hears_.clear();
  registry_.begin_step({sending(kFirst, 5)});
  EXPECT_EQ(opened_.size(), 1U);
  EXPECT_TRUE(registry_.waiting());
  hears_ = {kFirst};
  EXPECT_FALSE(registry_.waiting());
  const auto replies = registry_.end_step();
  ASSERT_EQ(replies.size(), 1U);
  EXPECT_EQ(replies[0], (RadioReply{.asker = {kFirst, Node{1}, 5}, .open = true, .unheard = {"gcs", "b"}}));
  EXPECT_EQ(admitted_, std::set<SourceId>{kFirst});
  EXPECT_TRUE(step().empty()) << "nothing has changed";
}

TEST_F(Registry, ARequestWithoutAMatchingWriterIsRefusedWithTheReason) {
  hears_.clear();
  const auto replies = step({sending(kFirst, 5)});
  ASSERT_EQ(replies.size(), 1U);
  EXPECT_FALSE(replies[0].open);
  EXPECT_NE(replies[0].reason.find("BEST_EFFORT"), std::string::npos);
  EXPECT_TRUE(admitted_.empty());
  EXPECT_EQ(registry_.decided_by_clock().size(), 1U) << "this refusal depends on wall time";
  EXPECT_TRUE(opened_.empty()) << "the endpoints made for the request are freed";
  hears_ = {kFirst};
  EXPECT_TRUE(step({sending(kFirst, 6)}).at(0).open) << "the member may ask again";
  EXPECT_TRUE(registry_.decided_by_clock().empty());
  EXPECT_EQ(opened_.size(), 1U);
}

TEST_F(Registry, TheFleetDoesNotWaitForAMemberAfterThreeRequestsWithoutAWriter) {
  hears_ = {kSecond};
  for (std::uint32_t id = 0; id < RadioRegistry::kMaxVain; ++id) {
    registry_.begin_step({sending(kFirst, id)});
    EXPECT_TRUE(registry_.waiting());
    EXPECT_FALSE(registry_.end_step().at(0).open);
  }
  registry_.begin_step({sending(kFirst, 9), sending(kSecond, 1)});
  EXPECT_FALSE(registry_.waiting()) << "the fleet does not wait for this member";
  const auto replies = registry_.end_step();
  ASSERT_EQ(replies.size(), 2U);
  EXPECT_NE(replies[0].reason.find("three times"), std::string::npos);
  EXPECT_TRUE(replies[1].open) << "requests of other members are answered as before";
  EXPECT_TRUE(registry_.decided_by_clock().empty()) << "this refusal depends on nothing but the requests";
}

TEST_F(Registry, ListenersMayComeFirstOrLater) {
  EXPECT_EQ(step({listening(kSecond, 1)}).at(0), (RadioReply{.asker = {kSecond, Node{2}, 1}})) << "no member sends yet";
  const auto replies = step({sending(kFirst, 1)});
  ASSERT_EQ(replies.size(), 2U);
  EXPECT_EQ(replies[0].unheard, (std::vector<std::string>{"gcs", "b"})) << "b has not opened its reader yet";
  EXPECT_EQ(replies[1], (RadioReply{.asker = {kSecond, Node{2}, 1}, .open = true}));
  reaches_.clear();
  registry_.begin_step({listening(kStation, 1)});
  EXPECT_TRUE(registry_.waiting())
      << "the new listener has matched the router; the router waits until it has matched the listener";
  reaches_ = {kFirst, kSecond, kStation};
  const auto more = registry_.end_step();
  ASSERT_EQ(more.size(), 2U);
  EXPECT_EQ(more[0].unheard, std::vector<std::string>{"gcs"});
  EXPECT_TRUE(more[1].open);
  EXPECT_TRUE(step().at(0).unheard.empty()) << "the router has matched a reader at each target";
}

TEST_F(Registry, DeclaredReadersCountAsListeners) {
  declared_ = {Node{0}, Node{2}};
  EXPECT_TRUE(step({sending(kFirst, 1)}).at(0).unheard.empty());
}

TEST_F(Registry, AListenerOfAnotherTypeThanTheSendersIsRefused) {
  EXPECT_TRUE(step({sending(kFirst, 1)}).at(0).open);
  const auto replies = step({listening(kSecond, 1, kOtherType), listening(kStation, 1)});
  ASSERT_EQ(replies.size(), 2U);
  EXPECT_EQ(replies[0].reason, "type: '/x' was declared as some/msg/Type before; a topic has one type");
  EXPECT_TRUE(replies[1].open);
}

TEST_F(Registry, AnotherTypeThanThatOfAnEarlierListenerIsRefusedAndTheListenerStays) {
  step({listening(kSecond, 1)});
  const auto wrong = step({sending(kFirst, 1, {"all"}, kOtherType), listening(kStation, 1, kOtherType)});
  ASSERT_EQ(wrong.size(), 2U);
  for (const RadioReply& reply : wrong) {
    EXPECT_NE(reply.asker.source, kSecond);
    EXPECT_EQ(reply.reason, "type: 'b' asked for '/x' as some/msg/Type before; a topic has one type");
  }
  EXPECT_TRUE(opened_.empty());
  const auto replies = step({sending(kFirst, 2)});
  ASSERT_EQ(replies.size(), 2U);
  EXPECT_TRUE(replies[0].open && replies[1].open);
  EXPECT_EQ(replies[1].asker.source, kSecond);
  EXPECT_EQ(step().at(0).unheard, std::vector<std::string>{"gcs"}) << "b has a matching reader";
}

TEST_F(Registry, AListenerMayCorrectItsOwnType) {
  step({listening(kSecond, 1, kOtherType)});
  EXPECT_TRUE(step({listening(kSecond, 2)}).at(0).reason.empty());
  EXPECT_TRUE(step({sending(kFirst, 1)}).at(0).open);
}

/// A sender without a writer asks with another type than all others, and is refused or lost.
TEST_F(Registry, ARefusedRequestDecidesNoType) {
  for (const bool in_the_same_step : {false, true}) {
    for (const bool is_lost : {false, true}) {
      RadioTable table(scenario_);
      std::set<SourceId> gone;
      std::vector<std::size_t> open;
      RadioRegistry registry(scenario_, table,
                             {.open = [&](std::size_t route) { open.push_back(route); },
                              .close = [&](std::size_t route) { std::erase(open, route); },
                              .hears = [](std::size_t, SourceId source) { return source != kFirst; },
                              .reaches = [](const RadioTarget&, SourceId) { return true; },
                              .declared = [](const RadioTarget&) { return false; },
                              .admit = [](std::size_t, SourceId) {},
                              .lost = [&](SourceId source) { return gone.contains(source); }});
      const RadioRequest wrong = sending(kFirst, 1, {"all"}, kOtherType);
      const std::vector<RadioRequest> right = {listening(kStation, 1), sending(kSecond, 1)};
      std::vector<RadioRequest> first = {wrong};
      if (in_the_same_step) first.insert(first.end(), right.begin(), right.end());
      registry.begin_step(first);
      EXPECT_TRUE(registry.waiting());
      if (is_lost) gone.insert(kFirst);
      auto replies = registry.end_step();
      ASSERT_EQ(replies.size(), is_lost ? 0U : 1U);
      if (!is_lost) {
        EXPECT_EQ(replies[0].asker.source, kFirst);
        EXPECT_NE(replies[0].reason.find("no matching writer"), std::string::npos) << replies[0].reason;
      }
      EXPECT_TRUE(open.empty());
      registry.begin_step(in_the_same_step ? std::vector<RadioRequest>() : right);
      EXPECT_FALSE(registry.waiting());
      replies = registry.end_step();
      ASSERT_EQ(replies.size(), 2U) << in_the_same_step << is_lost;
      for (const RadioReply& reply : replies) EXPECT_TRUE(reply.open) << reply.asker.source << ": " << reply.reason;
      EXPECT_EQ(open.size(), 1U);
    }
  }
}

TEST_F(Registry, ARequestWithAnotherTypeIsRefusedOnceTheTypeIsDecided) {
  hears_.clear();
  registry_.begin_step({sending(kFirst, 1), listening(kSecond, 1, kOtherType)});
  hears_ = {kFirst};
  EXPECT_EQ(registry_.end_step().size(), 1U) << "the second waits for the next step";
  const auto replies = step();
  ASSERT_EQ(replies.size(), 1U);
  EXPECT_EQ(replies[0].asker.source, kSecond);
  EXPECT_EQ(replies[0].reason, "type: '/x' was declared as some/msg/Type before; a topic has one type");
}

TEST_F(Registry, ARouteStaysOpenWhileMessagesOfALostSenderMayArrive) {
  step({sending(kFirst, 1)});
  ASSERT_EQ(opened_.size(), 1U);
  lost_ = {kFirst};
  hears_.clear();
  const SourceId successor = kFirst + 100;
  RadioRequest again = sending(kFirst, 2);
  again.asker.source = successor;
  const auto replies = step({again});
  ASSERT_EQ(replies.size(), 1U);
  EXPECT_FALSE(replies[0].open);
  EXPECT_EQ(opened_.size(), 1U) << "what the lost member sent may still arrive";
  EXPECT_FALSE(table_.routes().back().targets.empty());
}

TEST_F(Registry, ALostMemberIsForgotten) {
  step({sending(kFirst, 1), listening(kSecond, 1)});
  EXPECT_EQ(step().at(0).unheard, std::vector<std::string>{"gcs"});
  lost_ = {kSecond};
  EXPECT_EQ(step().at(0).unheard, (std::vector<std::string>{"gcs", "b"})) << "b has no listener any more";
  hears_.clear();
  lost_ = {kSecond, kFirst};
  registry_.begin_step({});
  EXPECT_FALSE(registry_.waiting());
  EXPECT_TRUE(registry_.end_step().empty());
}

TEST_F(Registry, AMemberMayAddTargetsButNotAskForAnotherNode) {
  EXPECT_EQ(step({sending(kFirst, 1, {"b"})}).at(0).unheard, std::vector<std::string>{"b"});
  EXPECT_EQ(step({sending(kFirst, 2, {"gcs"})}).at(0).unheard, (std::vector<std::string>{"b", "gcs"}));
  RadioRequest false_source = sending(kFirst, 3);
  false_source.source = "b";
  EXPECT_NE(step({false_source}).at(0).reason.find("'b' is not the asking node"), std::string::npos);
  EXPECT_NE(step({sending(kFirst, 4, {"a"})}).at(0).reason.find("is the source itself"), std::string::npos);
  EXPECT_EQ(table_.routes().back().targets.size(), 2U) << "a refused request changes nothing";
}

TEST_F(Registry, AMemberThatIsLostDuringTheWaitIsForgotten) {
  step({sending(kFirst, 1), listening(kSecond, 1)});
  step();
  hears_.clear();
  registry_.begin_step({sending(kSecond, 2)});
  EXPECT_TRUE(registry_.waiting());
  lost_ = {kSecond};
  EXPECT_FALSE(registry_.waiting());
  const auto replies = registry_.end_step();
  ASSERT_EQ(replies.size(), 1U) << "a lost member gets no reply";
  EXPECT_EQ(replies[0].asker.source, kFirst);
  EXPECT_EQ(replies[0].unheard, (std::vector<std::string>{"gcs", "b"}));
}

TEST_F(Registry, TheNumberOfAMembersTopicsIsLimited) {
  for (const bool listen : {false, true}) {
    const auto request = [&](SourceId source, const std::string& name) {
      RadioRequest made = listen ? listening(source, 7) : sending(source, 7);
      made.name = name;
      return made;
    };
    std::vector<RadioRequest> many;
    for (std::size_t i = 0; i < RadioRegistry::kMaxTopics; ++i)
      many.push_back(request(kFirst, "/t" + std::to_string(i)));
    for (const RadioReply& reply : step(many)) ASSERT_EQ(reply.reason, "");
    auto replies = step({request(kFirst, "/one_more")});
    std::erase_if(replies, [](const RadioReply& reply) { return reply.reason.empty(); });  // keeps only refusals
    ASSERT_EQ(replies.size(), 1U);
    EXPECT_NE(replies[0].reason.find("1024 registered topics at most"), std::string::npos) << replies[0].reason;
    for (const RadioReply& reply : step({request(kSecond, "/t0")})) EXPECT_EQ(reply.reason, "") << "another member may";
  }
}

}  // namespace
}  // namespace skein::router
