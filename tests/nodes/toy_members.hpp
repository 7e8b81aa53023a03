// Counterparts of a node under test, over a bus within this process: a server without a simulated world, and members
// without a planner. Each works only when it is polled.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bus/lockstep/client_node.hpp"
#include "bus/lockstep/names.hpp"
#include "bus/lockstep/server.hpp"
#include "core/radio/link_matrix.hpp"
#include "core/scenario/scenario.hpp"

namespace skein::test {

/// UAVs "a", "b", ... in a row; all may send to all on /talk.
inline Scenario toy_scenario(std::size_t uavs) {
  Scenario scenario;
  for (std::size_t i = 0; i < uavs; ++i) {
    UavConfig uav;
    uav.name = std::string(1, static_cast<char>('a' + i));
    uav.start = Vector2d(5.0 * static_cast<double>(i), 0.0);
    scenario.fleet.push_back(uav);
  }
  scenario.radio.push_back({"/talk", "std_msgs/msg/String", {"all"}, {"all"}});
  return scenario;
}

/// Runs some steps and publishes what `before_step` writes.
class ToyServer {
 public:
  using Domain = bus::LockstepServer::DomainIndex;

  ToyServer(bus::Bus& bus, const Scenario& scenario, std::uint64_t steps)
      : steps_(steps), links(scenario.fleet.size() + 1, 1), inbox_(0, bus.run()), lockstep_(inbox_) {
    participants_.push_back(bus.join(world_domain(0)));
    lockstep_.add_domain("", *participants_.back());
    for (const Node node : scenario.nodes()) {
      participants_.push_back(bus.join(node_domain(0, node)));
      lockstep_.add_domain(scenario.node_name(node), *participants_.back());
    }
  }

  /// Adds a member that the first step waits for.
  void expect(std::string_view member, Domain domain) { lockstep_.add_place(std::string(member), domain, true); }
  void expect_router() { expect(bus::kRouterName, kWorld); }
  void expect_station() { expect(bus::kStationName, kGcs); }
  void expect_uavs(const Scenario& scenario) {
    for (const UavIndex uav : scenario.uavs()) expect(scenario.fleet[uav].name, domain_of(uav));
  }
  static Domain domain_of(UavIndex uav) { return 2 + uav; }

  /// Opens the server's ends of all topics in a domain: agents match them before they take part.
  void open_topics(Domain domain, std::span<const topics::TopicInfo> table, const std::string& id) {
    for (const topics::TopicInfo& topic : table) {
      const bus::TopicSpec spec = bus::spec(topics::wire(topic, id));
      const bool from_agent =
          topic.direction == topics::Direction::from_agent || topic.pattern == topics::kCaptureStored.pattern;
      if (topic.direction == topics::Direction::from_station) continue;
      if (topic.direction == topics::Direction::shown_by_agent) continue;
      if (!from_agent) {
        writers_[{domain, spec.name}] = &lockstep_.writer(domain, spec);
        continue;
      }
      lockstep_.read(domain, spec, [this, key = std::pair(domain, spec.name)](bus::Sample&& sample) {
        if (on_sample_.contains(key)) on_sample_[key](std::move(sample));
      });
    }
  }
  bus::CountedWriter& writer(Domain domain, const topics::WireTopic& topic) {
    return *writers_.at({domain, topic.name});
  }
  /// Calls `handler` with each message that a member writes on one of these topics.
  template <class Message, class Handler>
  void on(Domain domain, const topics::WireTopic& topic, Handler handler) {
    on_sample_[{domain, topic.name}] = [handler](bus::Sample&& sample) {
      Message message;
      if (decode(sample.payload, message)) handler(message);
    };
  }

  bus::LockstepServer& lockstep() { return lockstep_; }
  bus::Participant& world() { return *participants_[kWorld]; }
  std::uint64_t k() const { return k_; }
  bool over() const { return k_ == steps_; }

  void poll() {
    inbox_.dispatch(std::chrono::milliseconds(0));
    if (over()) return;
    if (in_step_) {
      if (!lockstep_.answered()) return;
      in_step_ = false;
      ++k_;
    } else if (lockstep_.at_boundary()) {
      before_step(k_);
      lockstep_.publish({.k = k_,
                         .tick = static_cast<Tick>(20 * k_),
                         .links = links.row_major(),
                         .ledger_upto = ledger_upto,
                         .final_step = k_ + 1 == steps_});
      in_step_ = true;
    }
  }

 private:
  static constexpr Domain kWorld = 0, kGcs = 1;
  const std::uint64_t steps_;

 public:
  Links links;
  std::uint64_t ledger_upto = 0;
  std::function<void(std::uint64_t k)> before_step = [](std::uint64_t) {};

 private:
  bus::Inbox inbox_;
  std::vector<std::unique_ptr<bus::Participant>> participants_;
  bus::LockstepServer lockstep_;
  std::map<std::pair<Domain, std::string>, bus::CountedWriter*> writers_;
  std::map<std::pair<Domain, std::string>, std::function<void(bus::Sample&&)>> on_sample_;
  std::uint64_t k_ = 0;
  bool in_step_ = false;
};

/// A member that answers every step at once, after `on_step`.
class ToyMember final : public bus::ClientNode {
 public:
  ToyMember(bus::Bus& bus, int domain, std::string_view name)
      : inbox_(0, bus.run()), participant_(bus.join(domain)), client_(*participant_, inbox_, std::string(name)) {}

  bus::LockstepClient& client() override { return client_; }
  bus::Inbox& inbox() override { return inbox_; }
  std::function<void(const msg::Step&)> on_step = [](const msg::Step&) {};

 private:
  void think() override {
    on_step(client_.step());
    client_.done();
    answered_last_ = client_.step().final_step();
  }
  bool answered_last() const override { return answered_last_; }

  bus::Inbox inbox_;
  std::unique_ptr<bus::Participant> participant_;
  bus::LockstepClient client_;
  bool answered_last_ = false;
};

/// Calls all `turns` in order, round after round, until `done`. @returns false when it is not done after `rounds`.
bool take_turns(const std::vector<std::function<void()>>& turns, const auto& done, int rounds = 20000) {
  for (int round = 0; round < rounds && !done(); ++round) {
    for (const auto& turn : turns) turn();
  }
  return done();
}

}  // namespace skein::test
