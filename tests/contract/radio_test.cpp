// The radio, end to end, with every vendor: server, router and three members in lock-step, in one thread, with message
// types that exist only in this test. A topic of the scenario and topics that are registered during the run deliver
// messages of up to 4 MB bit for bit, to their permitted targets and to no other node.
#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <map>

#include "bus/lockstep/names.hpp"
#include "bus/lockstep/radio_topics.hpp"
#include "bus/lockstep/server.hpp"
#include "comm_router/router_node.hpp"
#include "core/math/random_stream.hpp"
#include "tests/contract/bus_fixture.hpp"
#include "tests/free_domain.hpp"

namespace skein::test {
namespace {

using bus::LockstepClient;

constexpr std::uint64_t kSteps = 26, kDeath = 20;
constexpr std::size_t kLarge = 4'000'000;
const std::vector<std::string> kNodes = {"gcs", "a", "b"};
const std::string kBlob = "/blob", kBlobType = "only_here/msg/Blob";
const std::string kLater = "/later", kLaterType = "only_here/msg/Later";

bool linked(std::size_t from, std::size_t to, std::uint64_t k) {
  if (from == to || (k >= kDeath && (from == 2 || to == 2))) return false;  // b is dead from step kDeath on
  return (from + 2 * to + k) % 3 != 0;
}

/// A node's message in a step, of any number of bytes; in each seventh step of 4 MB.
Bytes message_of(std::size_t node, const std::string& topic, std::uint64_t k) {
  const bool large = k % 7 == 5;
  return numbered(1000 * k + 10 * node + topic.size(), large ? kLarge + 3 * node : 8 + (k * 37 + node) % 5000);
}

Bytes padded(Bytes payload) {
  payload.resize((payload.size() + 3) / 4 * 4);
  return payload;
}

Scenario world() {
  Scenario scenario;
  scenario.name = "radio";
  for (const char* name : {"a", "b"}) {
    UavConfig uav;
    uav.name = name;
    scenario.fleet.push_back(uav);
  }
  scenario.radio.push_back({kBlob, kBlobType, {"a"}, {"all"}});
  return scenario;
}

/// A member: sends on both topics whenever they are open, and stores received messages by topic and step.
class Member {
 public:
  Member(const std::string& vendor, int base, Node node)
      : bus_(bus::make_bus({.vendor = vendor})),
        participant_(bus_->join(node_domain(base, node))),
        node_(node),
        client_(*participant_, inbox_, node == kStationNode ? std::string(bus::kStationName) : kNodes[node]),
        radio_(client_, kNodes[node]) {
    const auto spec = [](const std::string& name) {
      return bus::TopicSpec{name, wire_type(kBlobType), {.depth = topics::radio_depth(3)}};
    };
    if (node == 1) client_.declare_writer(spec("rt/blob"), LockstepClient::Counterpart::router);
    if (node != 1) client_.read(spec("rt/blob/" + kNodes[node]), LockstepClient::Counterpart::router, hear(kBlob));
    client_.start();
  }

  void poll() {
    inbox_.dispatch(std::chrono::milliseconds(0));
    if (client_.poll() != LockstepClient::Event::think) return;
    k_ = client_.step().k();
    radio_.begin_step();
    if (k_ == 1) radio_.listen(kLater, kLaterType, hear(kLater));
    if (k_ == 2 && node_ != 2) radio_.send(kLater, kLaterType, {node_ == 1 ? "b" : "all"});
    if (k_ == 3) send_invalid_requests();
    if (node_ == 1) client_.write("rt/blob", message_of(node_, kBlob, k_));
    if (radio_.write(kLater, message_of(node_, kLater, k_))) sent_.push_back(k_);
    client_.done();
    finished_ = client_.step().final_step();
  }
  bool finished() const { return finished_; }
  bus::RadioTopics::Status sending(const std::string& topic) const { return radio_.sending(topic); }

  std::map<std::string, std::vector<std::pair<std::uint64_t, Bytes>>> heard_;
  std::vector<std::uint64_t> sent_;  ///< steps in which it could send on the registered topic

 private:
  bus::CountedQueues::Handler hear(const std::string& topic) {
    return [this, topic](bus::Sample&& sample) {
      heard_[topic].emplace_back(client_.step().k(), std::move(sample.payload));
    };
  }

  /// Sends invalid requests, each invalid for another reason.
  void send_invalid_requests() {
    radio_.send("/itself", kLaterType, {kNodes[node_]});
    radio_.send("/nobody", kLaterType, {"nowhere"});
    radio_.send("/skein/mine", kLaterType, {"all"});
    radio_.send("/captures/x", kLaterType, {"all"});
    radio_.send("/score_eval", kLaterType, {"all"});
    radio_.send("/empty", kLaterType, {});
    if (node_ != 2) return;
    radio_.send(kLater, kBlobType, {"all"});
    radio_.send("/blob/b", kBlobType, {"all"});
  }

  std::unique_ptr<bus::Bus> bus_;
  bus::Inbox inbox_;
  std::unique_ptr<bus::Participant> participant_;
  const Node node_;
  LockstepClient client_;
  bus::RadioTopics radio_;
  std::uint64_t k_ = 0;
  bool finished_ = false;
};

class Server {
 public:
  Server(const std::string& vendor, int base) : bus_(bus::make_bus({.vendor = vendor})), server_(inbox_) {
    participants_.push_back(bus_->join(world_domain(base)));
    server_.add_place(std::string(bus::kRouterName), server_.add_domain("", *participants_[0]), true);
    for (const Node node : FirstNodes(kNodes.size())) {
      participants_.push_back(bus_->join(node_domain(base, node)));
      const auto domain = server_.add_domain(kNodes[node], *participants_.back());
      server_.add_place(node == kStationNode ? std::string(bus::kStationName) : kNodes[node], domain, true);
    }
  }

  void poll() {
    inbox_.dispatch(std::chrono::milliseconds(0));
    if (k_ == kSteps) return;
    if (!in_step_ && server_.at_boundary()) {
      std::vector<std::uint8_t> links;
      for (std::size_t from = 0; from < kNodes.size(); ++from) {
        for (std::size_t to = 0; to < kNodes.size(); ++to) links.push_back(linked(from, to, k_));
      }
      server_.publish({.k = k_, .tick = 20 * static_cast<Tick>(k_), .links = links, .final_step = k_ + 1 == kSteps});
      in_step_ = true;
    } else if (in_step_ && server_.answered()) {
      in_step_ = false;
      ++k_;
      digest_ += std::string(server_.routed_digest().begin(), server_.routed_digest().end());
    }
  }
  bool finished() const { return k_ == kSteps; }
  std::string awaits() const {
    std::string text = fmt::format("step {} awaits", k_);
    for (const auto& one : server_.awaited()) text += fmt::format(" {} ({})", one.member, one.what);
    return text;
  }
  const std::string& digest() const { return digest_; }

 private:
  std::unique_ptr<bus::Bus> bus_;
  bus::Inbox inbox_;
  std::vector<std::unique_ptr<bus::Participant>> participants_;
  bus::LockstepServer server_;
  std::uint64_t k_ = 0;
  bool in_step_ = false;
  std::string digest_;
};

/// The messages that a node must receive on a topic: step in which it receives them, payload.
std::vector<std::pair<std::uint64_t, Bytes>> expected(std::size_t to, const std::string& topic,
                                                      const std::vector<std::vector<std::uint64_t>>& sent) {
  std::vector<std::pair<std::uint64_t, Bytes>> list;
  for (std::uint64_t k = 0; k + 1 < kSteps; ++k) {
    for (std::size_t from = 0; from < kNodes.size(); ++from) {
      const bool sends = topic == kBlob ? from == 1 : std::ranges::find(sent[from], k) != sent[from].end();
      const bool targets = topic == kBlob || from == 0 || to == 2;
      if (sends && targets && linked(from, to, k)) list.emplace_back(k + 1, padded(message_of(from, topic, k)));
    }
  }
  return list;
}

/// The fleet of one test: the member of `a` uses the second vendor of the pair, all others use the first.
class Radio : public testing::TestWithParam<Pair> {
 protected:
  Radio() {
    for (const Node node : FirstNodes(kNodes.size())) {
      members_.push_back(std::make_unique<Member>(node == 1 ? GetParam().reader : GetParam().writer, base_, node));
    }
  }

  /// @param meanwhile  called repeatedly during the flight
  void fly(const std::function<void()>& meanwhile = [] {}) {
    router_.start();
    ASSERT_TRUE(eventually([&] {
      for (int n = 0; n < 20; ++n) {
        server_.poll();
        router_.poll();
        for (const auto& member : members_) member->poll();
        meanwhile();
      }
      return server_.finished();
    })) << server_.awaits()
        << "; " << router_.waiting_for();
  }

  /// The digest over all deliveries is the same with every vendor.
  void expect_usual_digest() const {
    static const std::string first = server_.digest();  // of the first vendor that was tested
    EXPECT_TRUE(server_.digest() == first);
  }

  const FreeDomains domains_{4};
  const int base_ = domains_.base();
  const Scenario scenario_ = world();
  Server server_{GetParam().writer, base_};
  const std::unique_ptr<bus::Bus> bus_ = bus::make_bus({.vendor = GetParam().writer});
  router::RouterNode router_{scenario_, 0, base_, *bus_};
  std::vector<std::unique_ptr<Member>> members_;
};

TEST_P(Radio, CarriesAnyTypeBitForBitToThePermittedNodes) {
  // A participant outside the fleet in the sender's domain, and one in a domain where a topic must not arrive.
  const auto at_a = bus_->join(node_domain(base_, Node{1})), at_gcs = bus_->join(node_domain(base_, Node{0}));
  std::atomic<int> back = 0, from_elsewhere = 0;
  const auto listen = [](bus::Participant& where, const std::string& name, auto& count) {
    return where.create_reader({name, wire_type(kBlobType), {.depth = 1000}}, [&count](bus::Sample&&) { ++count; });
  };
  const auto own_arrivals = listen(*at_a, "rt/blob/a", back),
             foreign_sends = listen(*at_gcs, "rt/blob", from_elsewhere);
  ASSERT_NO_FATAL_FAILURE(fly());

  std::vector<std::vector<std::uint64_t>> sent;
  for (const auto& member : members_) sent.push_back(member->sent_);
  EXPECT_EQ(sent[0].front(), 3U) << "a topic that is requested in step 2 must be open in step 3";
  EXPECT_EQ(sent[1].front(), 3U);
  EXPECT_TRUE(sent[2].empty()) << "this member never asked to send";
  for (std::size_t node = 0; node < kNodes.size(); ++node) {
    for (const std::string& topic : {kBlob, kLater}) {
      const auto must = expected(node, topic, sent);
      const auto& heard = members_[node]->heard_[topic];
      ASSERT_EQ(heard.size(), must.size()) << topic << " at " << kNodes[node];
      for (std::size_t i = 0; i < must.size(); ++i)
        EXPECT_TRUE(heard[i] == must[i]) << "message " << i << " on " << topic;
    }
  }
  EXPECT_EQ(back, 0) << "the router returned messages to their sender";
  EXPECT_EQ(from_elsewhere, 0) << "a message reached another domain under the topic name of its sender";
  const router::LinkCounts total = router_.gate().total();
  EXPECT_EQ(total.sent, total.delivered + total.dropped_no_los);
  expect_usual_digest();
}

TEST_P(Radio, InvalidSamplesFromOutsideTheFleetAreCountedAndChangeNothing) {
  RandomStream random(1, "noise", 0);
  std::vector<std::unique_ptr<bus::Participant>> strangers;
  std::vector<std::unique_ptr<bus::Writer>> writers;
  const auto bus = bus::make_bus({.vendor = GetParam().reader});
  for (int domain = base_; domain < base_ + 4; ++domain) {
    strangers.push_back(bus->join(domain));
    for (const topics::TopicInfo& topic : topics::lockstep_topics()) {
      writers.push_back(strangers.back()->create_writer(bus::spec(topics::wire(topic))));
    }
    writers.push_back(strangers.back()->create_writer({"rt/blob", wire_type(kBlobType), {}}));
  }
  ASSERT_NO_FATAL_FAILURE(fly([&] {
    Bytes noise(random.bits() % 100);
    for (std::uint8_t& byte : noise) byte = random.bits() % 2 == 0 ? 0 : static_cast<std::uint8_t>(random.bits() % 4);
    if (noise.size() > 1) noise[0] = 0, noise[1] = 1;
    writers[random.bits() % writers.size()]->write(noise);
  }));
  expect_usual_digest();
  EXPECT_GT(router_.malformed(), 0U);
}

TEST_P(Radio, RefusesInvalidRequestsWithAReason) {
  ASSERT_NO_FATAL_FAILURE(fly());
  const std::map<std::string, std::string> reasons = {
      {"/itself", "'b' is the source itself"},         {"/nobody", "there is no node 'nowhere'"},
      {"/skein/mine", "names under /skein/"},          {"/captures/x", "carry the score"},
      {"/score_eval", "is the station's own"},         {"/empty", "name at least one node"},
      {kLater, "asked for '/later' as " + kLaterType}, {"/blob/b", "is taken by what arrives of /blob"}};
  for (const auto& [topic, reason] : reasons) {
    const auto status = members_[2]->sending(topic);
    EXPECT_NE(status.refusal.find(reason), std::string::npos) << topic << ": " << status.refusal;
    EXPECT_FALSE(status.open) << topic;
  }
  EXPECT_TRUE(members_[0]->sending(kLater).open);
  EXPECT_EQ(members_[0]->sending(kLater).unheard, std::vector<std::string>()) << "a target's reader has not matched";
}

INSTANTIATE_TEST_SUITE_P(Vendors, Radio,
                         testing::Values(Pair{"inproc", "inproc"}, Pair{"cyclonedds", "cyclonedds"},
                                         Pair{"fastdds", "fastdds"}, Pair{"cyclonedds", "fastdds"}),
                         [](const auto& pair) { return name_of(pair.param); });

}  // namespace
}  // namespace skein::test
