// Registrations against a world of endpoints that match when the test says so.
#include "comm_router/radio_registry.hpp"

#include <gtest/gtest.h>

#include <set>

namespace skein::router {
namespace {

constexpr SourceId kFirst = 11, kSecond = 12, kStation = 10;
const std::string kType = "some/msg/Type";

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

  static RadioRequest sending(SourceId source, std::uint32_t id, std::vector<std::string> targets = {"all"}) {
    return {.asker = {source, node(source), id},
            .listen = false,
            .source = three_nodes().node_name(node(source)),
            .targets = std::move(targets),
            .name = "/x",
            .type = kType};
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

TEST_F(Registry, OpensOnceTheWriterIsFound) {
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

TEST_F(Registry, SaysThatThereIsNoFittingWriter) {
  hears_.clear();
  const auto replies = step({sending(kFirst, 5)});
  ASSERT_EQ(replies.size(), 1U);
  EXPECT_FALSE(replies[0].open);
  EXPECT_NE(replies[0].reason.find("BEST_EFFORT"), std::string::npos);
  EXPECT_TRUE(admitted_.empty());
  EXPECT_EQ(registry_.decided_by_clock().size(), 1U) << "with more patience it might have been found";
  EXPECT_TRUE(opened_.empty()) << "what was made for it is freed";
  hears_ = {kFirst};
  EXPECT_TRUE(step({sending(kFirst, 6)}).at(0).open) << "it may ask again";
  EXPECT_TRUE(registry_.decided_by_clock().empty());
  EXPECT_EQ(opened_.size(), 1U);
}

TEST_F(Registry, WhoAsksInVainAgainAndAgainIsNotWaitedForAnyMore) {
  hears_ = {kSecond};
  for (std::uint32_t id = 0; id < RadioRegistry::kMaxVain; ++id) {
    registry_.begin_step({sending(kFirst, id)});
    EXPECT_TRUE(registry_.waiting());
    EXPECT_FALSE(registry_.end_step().at(0).open);
  }
  registry_.begin_step({sending(kFirst, 9), sending(kSecond, 1)});
  EXPECT_FALSE(registry_.waiting()) << "the fleet does not stand still for it";
  const auto replies = registry_.end_step();
  ASSERT_EQ(replies.size(), 2U);
  EXPECT_NE(replies[0].reason.find("three times"), std::string::npos);
  EXPECT_TRUE(replies[1].open) << "others are heard as before";
  EXPECT_TRUE(registry_.decided_by_clock().empty()) << "this refusal depends on nothing but the requests";
}

TEST_F(Registry, ListenersMayComeFirstOrLater) {
  EXPECT_EQ(step({listening(kSecond, 1)}).at(0), (RadioReply{.asker = {kSecond, Node{2}, 1}})) << "nobody sends yet";
  const auto replies = step({sending(kFirst, 1)});
  ASSERT_EQ(replies.size(), 2U);
  EXPECT_EQ(replies[0].unheard, (std::vector<std::string>{"gcs", "b"})) << "b has yet to open its reader";
  EXPECT_EQ(replies[1], (RadioReply{.asker = {kSecond, Node{2}, 1}, .open = true}));
  reaches_.clear();
  registry_.begin_step({listening(kStation, 1)});
  EXPECT_TRUE(registry_.waiting()) << "b says by its answer that it has found us; we wait until we have found it";
  reaches_ = {kFirst, kSecond, kStation};
  const auto more = registry_.end_step();
  ASSERT_EQ(more.size(), 2U);
  EXPECT_EQ(more[0].unheard, std::vector<std::string>{"gcs"});
  EXPECT_TRUE(more[1].open);
  EXPECT_TRUE(step().at(0).unheard.empty()) << "both ends of all are matched";
}

TEST_F(Registry, DeclaredReadersHear) {
  declared_ = {Node{0}, Node{2}};
  EXPECT_TRUE(step({sending(kFirst, 1)}).at(0).unheard.empty());
}

TEST_F(Registry, ListenerOfAnotherTypeIsRefused) {
  EXPECT_TRUE(step({listening(kSecond, 1, "other/msg/Type")}).at(0).reason.empty()) << "it may still become right";
  const auto replies = step({sending(kFirst, 1), listening(kStation, 1, "other/msg/Type")});
  ASSERT_EQ(replies.size(), 3U);
  for (const RadioReply& reply : replies) EXPECT_EQ(reply.open, reply.asker.source == kFirst) << reply.asker.source;
}

TEST_F(Registry, TheLostAreForgotten) {
  step({sending(kFirst, 1), listening(kSecond, 1)});
  EXPECT_EQ(step().at(0).unheard, std::vector<std::string>{"gcs"});
  lost_ = {kSecond};
  EXPECT_EQ(step().at(0).unheard, (std::vector<std::string>{"gcs", "b"})) << "nobody listens there any more";
  hears_.clear();
  lost_ = {kSecond, kFirst};
  registry_.begin_step({});
  EXPECT_FALSE(registry_.waiting());
  EXPECT_TRUE(registry_.end_step().empty());
}

TEST_F(Registry, MoreTargetsMayBeAddedAndTheSourceIsTheAsker) {
  EXPECT_EQ(step({sending(kFirst, 1, {"b"})}).at(0).unheard, std::vector<std::string>{"b"});
  EXPECT_EQ(step({sending(kFirst, 2, {"gcs"})}).at(0).unheard, (std::vector<std::string>{"b", "gcs"}));
  RadioRequest false_source = sending(kFirst, 3);
  false_source.source = "b";
  EXPECT_NE(step({false_source}).at(0).reason.find("'b' is not the asking node"), std::string::npos);
  EXPECT_NE(step({sending(kFirst, 4, {"a"})}).at(0).reason.find("is the source itself"), std::string::npos);
  EXPECT_EQ(table_.routes().back().targets.size(), 2U) << "a refused request changes nothing";
}

TEST_F(Registry, WhoIsLostWhileTheOthersAreAwaitedIsForgotten) {
  step({sending(kFirst, 1), listening(kSecond, 1)});
  step();
  hears_.clear();
  registry_.begin_step({sending(kSecond, 2)});
  EXPECT_TRUE(registry_.waiting());
  lost_ = {kSecond};
  EXPECT_FALSE(registry_.waiting());
  const auto replies = registry_.end_step();
  ASSERT_EQ(replies.size(), 1U) << "none to the lost";
  EXPECT_EQ(replies[0].asker.source, kFirst);
  EXPECT_EQ(replies[0].unheard, (std::vector<std::string>{"gcs", "b"}));
}

TEST_F(Registry, AMemberHasSoManyTopicsAndNoMore) {
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
    std::erase_if(replies, [](const RadioReply& reply) { return reply.reason.empty(); });  // what changed for others
    ASSERT_EQ(replies.size(), 1U);
    EXPECT_NE(replies[0].reason.find("1024 registered topics at most"), std::string::npos) << replies[0].reason;
    for (const RadioReply& reply : step({request(kSecond, "/t0")})) EXPECT_EQ(reply.reason, "") << "another member may";
  }
}

}  // namespace
}  // namespace skein::router
