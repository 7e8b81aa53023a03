// The programs of the model: the production server, router and clients, with toy planners. Only for fleet_model.cpp.
#pragma once

#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>

#include <functional>

#include "bus/lockstep/names.hpp"
#include "bus/lockstep/radio_topics.hpp"
#include "bus/lockstep/server.hpp"
#include "comm_router/router_node.hpp"
#include "core/radio/radio_routes.hpp"
#include "tests/protocol/fleet_model.hpp"

namespace skein::test {

using bus::LockstepClient;

inline constexpr std::chrono::milliseconds kNow{0};

inline std::uint64_t fnv1a(std::uint64_t hash, const std::string& text) {
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}

inline bus::TopicSpec text_topic(const std::string& name, int depth) {
  return {name, type_name<msg::String>(), bus::Qos{.reliable = true, .latched = false, .depth = depth}};
}

inline bus::TopicSpec sensor_topic(const std::string& id) { return text_topic("rt/" + id + "/sensor", 8); }
inline bus::TopicSpec site_topic(const std::string& id) {
  bus::TopicSpec topic = text_topic("rt/" + id + "/site", 2);
  topic.qos.latched = true;
  return topic;
}
inline bus::TopicSpec command_topic(const std::string& id) { return text_topic("rt/" + id + "/command", 8); }

inline msg::String text_message(const std::string& text) {
  msg::String message;
  message.data(text);
  return message;
}

inline std::string text_of(const bus::Sample& sample) {
  msg::String message;
  return decode(sample.payload, message) ? message.data() : "malformed";
}

class ServerProcess final : public Process {
 public:
  ServerProcess(FleetModel& model, SimNetwork& network) : model_(model), bus_(network), server_(inbox_) {
    const Scenario& scenario = model.scenario_;
    participants_.push_back(bus_.join(world_domain(0)));
    const auto world = server_.add_domain("", *participants_.back());
    participants_.push_back(bus_.join(gcs_domain(0)));
    const auto gcs = server_.add_domain("gcs", *participants_.back());
    for (std::size_t i = 0; i < scenario.fleet.size(); ++i) {
      const std::string& id = scenario.fleet[i].name;
      participants_.push_back(bus_.join(uav_domain(0, UavIndex(i))));
      const auto domain = server_.add_domain(id, *participants_.back());
      server_.add_place(id, domain, true);
      sensors_.push_back(&server_.writer(domain, sensor_topic(id)));
      sites_.push_back(&server_.writer(domain, site_topic(id)));
      server_.read(domain, command_topic(id),
                   [this, id](bus::Sample&& sample) { model_.taken_[id][k_].push_back(text_of(sample)); });
    }
    server_.add_place(std::string(bus::kStationName), gcs, true);
    server_.add_place(std::string(bus::kRouterName), world, true);
  }

  void poll() override {
    // During a step it sleeps until its inbox rings, as SimNode does.
    if (in_step_ && !inbox_.ready(server_.rings())) return;
    inbox_.dispatch(kNow);
    for (const auto& lost : server_.take_lost()) model_.lost_.push_back(lost.name);
    if (finished_) return;
    const ProcessFault& fault = model_.options_.fault;
    if (!in_step_) {
      // In the same order as SimNode.
      if (out_ && k_ == fault.end) {
        out_ = false;
        if (server_.let_back(fault.victim)) model_.called_back_.insert(fault.victim);
      }
      if (!server_.at_boundary()) return;
      for (const auto& name : server_.take_rejoined()) model_.rejoined_.push_back(name);
      if (!fault.victim.empty() && k_ == fault.begin) {
        out_ = server_.take_out(fault.victim, fault.kill ? bus::kOrderKill : bus::kOrderStop);
      }
      publish();
    } else if (server_.answered()) {
      in_step_ = false;
      finished_ = ++k_ == model_.options_.steps;
    }
  }
  bool finished() const override { return finished_; }
  void lost(const std::string& name) {
    inbox_.post([this, name] { server_.lost(name, "killed"); });
  }
  std::string awaits() const {
    std::string text = (in_step_ ? "step " : "boundary before ") + std::to_string(k_) + " awaits";
    for (const auto& one : server_.awaited()) text += " " + one.member + " (" + one.what + ")";
    return text;
  }
  /// @returns false when the server awaits no member.
  bool give_up_awaited() {
    const auto awaited = server_.awaited();
    for (const auto& one : awaited) {
      model_.given_up_.push_back(one.member + ": " + one.what);
      server_.lost(one.member, "given up");
    }
    return !awaited.empty();
  }
  /// Repeated requests are harmless at any time.
  void ask_again() { server_.ask_again(); }

 private:
  void publish() {
    if (const auto& loss = model_.options_.loses; loss && loss->k == k_)
      model_.network_.lose_next(loss->domain, loss->topic);
    const std::size_t nodes = sensors_.size() + 1;
    std::vector<std::uint8_t> links(nodes * nodes, 0);
    for (std::size_t from = 0; from < nodes; ++from) {
      for (std::size_t to = 0; to < nodes; ++to) links[from * nodes + to] = linked_in_model(from, to, k_);
    }
    for (std::size_t i = 0; i < sensors_.size(); ++i) {
      for (std::uint64_t n = 0; n < (k_ + i) % 3; ++n) {
        sensors_[i]->write(text_message(fmt::format("s{}.{}", k_, n)));
      }
      if (tells_site_in_model(k_)) sites_[i]->write(text_message(fmt::format("site{}", k_)));
    }
    server_.publish({.k = k_,
                     .tick = static_cast<std::int64_t>(20 * k_),
                     .links = links,
                     .ledger_upto = 0,
                     .final_step = k_ + 1 == model_.options_.steps});
    in_step_ = true;
  }

  FleetModel& model_;
  SimBus bus_;
  bus::Inbox inbox_{0};
  std::vector<std::unique_ptr<bus::Participant>> participants_;
  bus::LockstepServer server_;
  std::vector<bus::CountedWriter*> sensors_, sites_;
  std::uint64_t k_ = 0;
  bool in_step_ = false, finished_ = false, out_ = false;
};

/// An agent, or the station: a member with a radio and no sensors.
class AgentProcess final : public Process {
 public:
  AgentProcess(FleetModel& model, SimNetwork& network, const std::string& name, int domain, Node node, std::string life,
               RunId run = RunId::none)
      : model_(model),
        bus_(network, run),
        inbox_(0, run),
        name_(name),
        domain_(domain),
        node_(node),
        life_(std::move(life)) {
    join();
  }

  void poll() override {
    // Sleeps until its inbox rings, as run_client() does, so a fleet that needs a timeout to continue is a deadlock.
    if (!client_->waits_for_matches() && !inbox_.ready(client_->rings())) return;
    inbox_.dispatch(kNow);
    if (client_->poll() != LockstepClient::Event::think) return;
    log_.k = client_->step().k();
    for (const std::string& text : log_.heard) mind_ = fnv1a(mind_, text);
    mind_ = fnv1a(mind_, std::to_string(log_.k));
    const bool commands = name_ != bus::kStationName;
    for (std::uint64_t n = 0; commands && n < mind_ % 3; ++n) {
      log_.commanded.push_back(life_ + "c" + std::to_string(mind_ % 1000) + "." + std::to_string(n));
      client_->write("rt/" + name_ + "/command", text_message(log_.commanded.back()));
    }
    for (std::uint64_t n = 0; n < (mind_ >> 8) % 3; ++n) {
      const std::string said =
          life_ + "@" + std::to_string(log_.k) + "." + std::to_string(n) + "m" + std::to_string(mind_ % 1000);
      if (client_->write("rt/talk", text_message(said))) log_.said.push_back(said);
    }
    chat();
    misbehave();
    client_->done();
    finished_ = client_->step().final_step();
    model_.agents_[life_].push_back(std::exchange(log_, {}));
  }
  /// Keeps its planner state, but joins the network as a new participant.
  void resume() override {
    radio_.reset();
    client_.reset();
    join();
  }
  bool finished() const override { return finished_; }
  bool took_part() const override { return client_->is_member(); }
  std::string waits() const { return life_ + ": " + client_->waiting_for(); }

 private:
  void join() {
    participant_ = bus_.join(domain_);
    client_.emplace(*participant_, inbox_, name_);
    client_->obey_with(model_.obey(name_));
    radio_.emplace(*client_, model_.scenario_.node_name(node_));
    turn_ = 0;
    const auto hear = [this](bus::Sample&& sample) { log_.heard.push_back(text_of(sample)); };
    if (node_ != kStationNode) {
      client_->read(sensor_topic(name_), LockstepClient::Counterpart::server, hear);
      client_->read(site_topic(name_), LockstepClient::Counterpart::server, hear);
      client_->declare_writer(command_topic(name_), LockstepClient::Counterpart::server);
    }
    const std::string arrival = wire_topic(arrival_topic("/talk", model_.scenario_.node_name(node_)));
    client_->read(text_topic(arrival, 1024), LockstepClient::Counterpart::router, hear);
    client_->declare_writer(text_topic("rt/talk", 256), LockstepClient::Counterpart::router);
    client_->start();
  }

  void misbehave() {
    if (name_ != "a") return;
    const FleetOptions& options = model_.options_;
    if (log_.k == options.closes_writer) model_.network_.close_writers(domain_, "rt/talk");
    if (log_.k != options.announces_too_much) return;
    model_.network_.lose_next(domain_, "rt/talk");
    client_->write("rt/talk", text_message("lost"));
  }

  /// Sends on a topic that is registered at run time. The state of the registration counts as received input.
  void chat() {
    const std::string topic = "/chat", type = "std_msgs/msg/String";
    radio_->begin_step();
    ++turn_;
    if (turn_ == (node_ == kStationNode ? 2 : 1)) {
      radio_->listen(topic, type, [this](bus::Sample&& sample) { log_.heard.push_back(text_of(sample)); });
    }
    if (turn_ == 2) radio_->send(topic, type, {"all"});
    if (turn_ == 3) radio_->send("/talk", "std_msgs/msg/Other", {"all"});
    log_.listening = radio_->listening(topic).open;
    std::string status = "chat " + std::to_string(log_.listening) + std::to_string(radio_->sending(topic).open);
    for (const std::string& node : radio_->sending(topic).unheard) status += " " + node;
    log_.heard.push_back(status + radio_->sending("/talk").refusal);
    for (std::uint64_t n = 0; n < 2; ++n) {
      const std::string said = life_ + "@" + std::to_string(log_.k) + ".chat" + std::to_string(n);
      if (radio_->write(topic, encode(text_message(said)))) log_.said.push_back(said);
    }
  }

  FleetModel& model_;
  SimBus bus_;
  bus::Inbox inbox_;
  std::unique_ptr<bus::Participant> participant_;
  const std::string name_;
  const int domain_;
  const Node node_;
  const std::string life_;
  std::optional<LockstepClient> client_;
  std::optional<bus::RadioTopics> radio_;
  int turn_ = 0;  ///< steps since it joined
  StepLog log_;
  std::uint64_t mind_ = 0xcbf29ce484222325;
  bool finished_ = false;
};

class RouterProcess final : public Process {
 public:
  using Obey = std::function<void(LockstepClient::Order)>;
  RouterProcess(const Scenario& scenario, SimNetwork& network, Obey obey)
      : scenario_(scenario), bus_(network), obey_(std::move(obey)) {
    resume();
  }
  void poll() override { node_->poll(); }
  void resume() override {
    node_.reset();
    node_ = std::make_unique<router::RouterNode>(scenario_, 0, 0, bus_);
    node_->set_patience(router::kMatchPatience_s, 1e-9);
    node_->obey_with(obey_);
    node_->start();
  }
  bool finished() const override { return true; }
  std::string waits() const { return node_->waiting_for(); }

 private:
  const Scenario& scenario_;
  SimBus bus_;
  Obey obey_;
  std::unique_ptr<router::RouterNode> node_;
};

}  // namespace skein::test
