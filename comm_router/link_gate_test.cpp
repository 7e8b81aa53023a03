#include "comm_router/link_gate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <tuple>

namespace skein::router {
namespace {

constexpr std::size_t kNodes = 4;

RadioRoute route(Node source, const std::string& topic, std::vector<Node> targets) {
  RadioRoute made{source, topic, "std_msgs/msg/String", "rt" + topic, "std_msgs::msg::dds_::String_", {}};
  for (const Node target : targets) made.targets.push_back({target, "rt" + topic + "/n" + std::to_string(target)});
  return made;
}

/// Two topics of every node, to every other node, in an order that is not the order of delivery.
std::vector<RadioRoute> all_to_all() {
  std::vector<RadioRoute> routes;
  for (const std::string topic : {"/zulu", "/alpha"}) {
    for (std::size_t n = kNodes; n-- > 0;) {
      const Node source(n);
      std::vector<Node> targets;
      for (const Node target : FirstNodes(kNodes)) {
        if (target != source) targets.push_back(target);
      }
      routes.push_back(route(source, topic, targets));
    }
  }
  return routes;
}

SentMessage routed_message(std::size_t route_index, std::uint64_t sequence, const std::string& text) {
  return {route_index, sequence, std::make_shared<const std::vector<std::uint8_t>>(text.begin(), text.end())};
}

const Links kAllLinked(kNodes, 1), kNoneLinked(kNodes, 0);
const std::vector<RadioRoute> kAllToAll = all_to_all();

/// Random links (not symmetric: the gate must look at the right half of the matrix).
Links random_links(std::mt19937& random) {
  std::vector<std::uint8_t> links(kNodes * kNodes);
  for (std::uint8_t& link : links) link = random() % 2;
  return {kNodes, std::move(links)};
}

/// Delays messages by their sequence number modulo 3. Of eleven messages, it loses two by a fault and one by a full
/// queue, and sends three twice.
class LateLinks final : public LinkModel {
 public:
  LinkFate fate(std::uint64_t, const RadioRoute&, Node, const SentMessage& message) override {
    const std::uint64_t n = message.sequence % 11;
    const LinkLoss loss = n == 6 || n == 9 ? LinkLoss::fault : (n == 8 ? LinkLoss::overflow : LinkLoss::none);
    return {loss, message.sequence % 3, n >= 3 && n < 6 ? 2 : 1};
  }
};

TEST(LinkGate, ExactlyTheLinkedTargetsGetAMessage) {
  std::mt19937 random(1);
  LinkGate gate(kAllToAll, kNodes);
  for (std::uint64_t k = 0; k < 200; ++k) {
    const Links links = random_links(random);
    std::vector<SentMessage> messages;
    for (std::size_t r = 0; r < gate.routes().size(); ++r) messages.push_back(routed_message(r, k, "m"));
    const GatedStep step = gate.gate(k, links, messages);
    std::size_t expected = 0;
    for (const RadioRoute& from : gate.routes()) {
      for (const RadioTarget& to : from.targets) expected += links.at(from.source, to.node);
    }
    EXPECT_EQ(step.deliveries.size(), expected);
    for (const Delivery& delivery : step.deliveries) {
      const RadioRoute& from = gate.routes()[delivery.route];
      EXPECT_EQ(links.at(from.source, from.targets[delivery.target].node), 1);
      EXPECT_EQ(delivery.sequence, k);
    }
  }
}

TEST(LinkGate, DeliveriesAreOrderedBySourceTopicSequenceTarget) {
  std::mt19937 random(2);
  LinkGate gate(kAllToAll, kNodes);
  std::vector<SentMessage> messages;
  for (std::size_t r = 0; r < gate.routes().size(); ++r) {
    for (std::uint64_t sequence = 0; sequence < 3; ++sequence) messages.push_back(routed_message(r, sequence, "m"));
  }
  const GatedStep step = gate.gate(0, kAllLinked, messages);
  const auto key = [&](const Delivery& delivery) {
    const RadioRoute& from = gate.routes()[delivery.route];
    return std::tuple(from.source, from.ros_topic, delivery.sequence, from.targets[delivery.target].node);
  };
  EXPECT_TRUE(std::ranges::is_sorted(step.deliveries, {}, key));

  // Messages of different nodes may come in any order: deliveries and digest are the same.
  const auto source = [&](const SentMessage& m) { return gate.routes()[m.route].source; };
  std::ranges::stable_sort(messages, std::greater{}, source);
  LinkGate other(kAllToAll, kNodes);
  EXPECT_EQ(other.gate(0, kAllLinked, messages).digest, step.digest);
}

TEST(LinkGate, CountsAddUpOnEveryLink) {
  std::mt19937 random(3);
  LinkGate gate(kAllToAll, kNodes, std::make_unique<LateLinks>());
  std::vector<std::uint64_t> sequence(gate.routes().size(), 0);
  for (std::uint64_t k = 0; k < 100; ++k) {
    std::vector<SentMessage> messages;
    for (std::size_t r = 0; r < gate.routes().size(); ++r) {
      for (std::uint64_t n = random() % 3; n > 0; --n) messages.push_back(routed_message(r, sequence[r]++, "m"));
    }
    gate.gate(k, random_links(random), messages);
  }
  for (std::uint64_t k = 100; k < 103; ++k) gate.gate(k, kNoneLinked, {});  // delayed messages arrive
  LinkCounts sum;
  for (const Node from : FirstNodes(kNodes)) {
    for (const Node to : FirstNodes(kNodes)) {
      const LinkCounts& link = gate.counts().at(from, to);
      const std::uint64_t lost = link.dropped_no_los + link.dropped_fault + link.dropped_overflow;
      EXPECT_EQ(link.sent + link.duplicated, link.delivered + lost);
      EXPECT_EQ(link.sent > 0, from != to);
      EXPECT_EQ(link.sent_bytes, link.sent) << "each message has one byte";
      EXPECT_EQ(link.delivered_bytes, link.delivered);
      sum.sent += link.sent;
      sum.delivered += link.delivered;
      sum.dropped_no_los += link.dropped_no_los;
      sum.dropped_fault += link.dropped_fault;
      sum.dropped_overflow += link.dropped_overflow;
      sum.duplicated += link.duplicated;
      sum.sent_bytes += link.sent_bytes;
      sum.delivered_bytes += link.delivered_bytes;
    }
  }
  EXPECT_EQ(gate.total(), sum);
  // The counters have the different sizes that the model gives, so none counts in place of another.
  const double passed = static_cast<double>(sum.sent - sum.dropped_no_los);
  EXPECT_NEAR(static_cast<double>(sum.dropped_no_los), 0.5 * static_cast<double>(sum.sent), 0.1 * passed);
  EXPECT_NEAR(static_cast<double>(sum.dropped_fault), passed * 2.0 / 11.0, 0.03 * passed);
  EXPECT_NEAR(static_cast<double>(sum.dropped_overflow), passed / 11.0, 0.03 * passed);
  EXPECT_NEAR(static_cast<double>(sum.duplicated), passed * 3.0 / 11.0, 0.03 * passed);
}

TEST(LinkGate, ADelayedMessageKeepsTheLinkItWasSentOn) {
  const std::vector<RadioRoute> routes = {route(Node{1}, "/x", {kStationNode})};
  LinkGate gate(routes, kNodes, std::make_unique<LateLinks>());
  EXPECT_TRUE(gate.gate(0, kAllLinked, {routed_message(0, 2, "two steps late")}).deliveries.empty());
  EXPECT_TRUE(gate.gate(1, kNoneLinked, {}).deliveries.empty());
  const GatedStep third = gate.gate(2, kNoneLinked, {routed_message(0, 3, "no line of sight")});
  ASSERT_EQ(third.deliveries.size(), 1U);
  EXPECT_EQ(third.deliveries[0].sequence, 2U);
  EXPECT_EQ(gate.counts().at(Node{1}, kStationNode), (LinkCounts{.sent = 2,
                                                                 .delivered = 1,
                                                                 .dropped_no_los = 1,
                                                                 .sent_bytes = 30,  // both texts
                                                                 .delivered_bytes = 14}));
}

TEST(LinkGate, TheDigestSeesEveryFieldOfADelivery) {
  const auto digest = [](const RadioRoute& from, const SentMessage& sent) {
    const std::vector<RadioRoute> routes = {from};
    return LinkGate(routes, kNodes).gate(0, kAllLinked, {sent}).digest;
  };
  const RadioRoute base = route(Node{1}, "/x", {Node{2}});
  const auto reference = digest(base, routed_message(0, 5, "hello"));
  EXPECT_EQ(reference.size(), 32U);
  EXPECT_EQ(digest(base, routed_message(0, 5, "hello")), reference);
  EXPECT_NE(digest(base, routed_message(0, 6, "hello")), reference);
  EXPECT_NE(digest(base, routed_message(0, 5, "hellp")), reference);
  EXPECT_NE(digest(route(Node{3}, "/x", {Node{2}}), routed_message(0, 5, "hello")), reference);
  EXPECT_NE(digest(route(Node{1}, "/y", {Node{2}}), routed_message(0, 5, "hello")), reference);
  EXPECT_NE(digest(route(Node{1}, "/x", {Node{3}}), routed_message(0, 5, "hello")), reference);
}

TEST(LinkGate, WithoutADeliveryThereIsNoDigest) {
  const std::vector<RadioRoute> routes = {route(Node{1}, "/x", {Node{2}})};
  LinkGate gate(routes, kNodes);
  EXPECT_TRUE(gate.gate(0, kNoneLinked, {routed_message(0, 0, "lost")}).digest.empty());
  EXPECT_TRUE(gate.gate(1, kAllLinked, {}).digest.empty());
}

TEST(LinkGate, AMatrixOfAnotherSizeIsRefused) {
  const std::vector<RadioRoute> routes = {route(Node{1}, "/x", {Node{2}})};
  LinkGate gate(routes, kNodes);
  EXPECT_THROW(gate.gate(0, Links(3, 1), {}), std::invalid_argument);
  EXPECT_THROW(gate.gate(0, kAllLinked, {routed_message(1, 0, "?")}), std::invalid_argument);
}

}  // namespace
}  // namespace skein::router
