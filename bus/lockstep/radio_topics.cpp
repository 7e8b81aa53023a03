#include "bus/lockstep/radio_topics.hpp"

#include <utility>

#include "bus/lockstep/names.hpp"
#include "core/radio/radio_routes.hpp"

namespace skein::bus {
namespace {

TopicSpec radio_topic(const std::string& topic, const std::string& type, std::size_t sources) {
  return {wire_topic(topic), wire_type(type),
          Qos{.reliable = true, .latched = false, .depth = topics::radio_depth(sources)}};
}

msg::RadioRequest make_request(RunId run, const std::string& topic, const std::string& type) {
  auto request = message_of<msg::RadioRequest>(run);
  request.name(topic);
  request.type(type);
  return request;
}

}  // namespace

RadioTopics::RadioTopics(LockstepClient& client, std::string node)
    : client_(client), node_(std::move(node)), self_(client.id()) {
  client.declare_writer(spec(topics::radio_request()), LockstepClient::Counterpart::router);
  client.read<msg::RadioReply>(spec(topics::radio_reply()), LockstepClient::Counterpart::router,
                               [this](const msg::RadioReply& reply) { on_reply(reply); });
}

void RadioTopics::send(const std::string& topic, const std::string& type, const std::vector<std::string>& targets) {
  const TopicSpec spec = radio_topic(topic, type, 1);
  begin_step();
  const auto entry = sendings_.try_emplace(topic).first;
  client_.add_radio_writer(spec);
  entry->second.request = make_request(client_.run(), topic, type);
  entry->second.request.source(node_);
  entry->second.request.targets(targets);
  entry->second.status.refusal.clear();
  ask(entry->second.request);
}

void RadioTopics::listen(const std::string& topic, const std::string& type, CountedQueues::Handler handler) {
  radio_topic(topic, type, 1);  // throws when malformed
  begin_step();
  const auto [entry, fresh] = listenings_.try_emplace(topic);
  Listening& listening = entry->second;
  listening.handler = std::move(handler);
  const bool asked = !fresh && listening.request.type() == type && listening.status.refusal.empty();
  if (asked || listening.status.open) return;
  listening.request = make_request(client_.run(), topic, type);
  listening.request.listen(true);
  listening.status = {};
  ask(listening.request);
}

// While the router is away, this sends nothing; begin_step() will send the request to the next router.
void RadioTopics::ask(msg::RadioRequest& request) {
  request.id(++last_id_);
  client_.write(topics::radio_request().name, request);
}

void RadioTopics::begin_step() {
  if (client_.router() == router_) return;
  router_ = client_.router();
  const auto ask_anew = [this](auto& registrations) {
    for (auto& [topic, registration] : registrations) {
      // Not repeated: the new router could open a refused request in place of the one to which it lost before.
      if (!registration.status.refusal.empty()) continue;
      registration.status = {};
      ask(registration.request);
    }
  };
  ask_anew(sendings_);
  ask_anew(listenings_);
}

void RadioTopics::on_reply(const msg::RadioReply& reply) {
  if (reply.asker() != self_) return;  // reply to another program at this node
  const Status status{reply.open(), reply.reason(), reply.unheard()};
  for (auto& [topic, sending] : sendings_) {
    if (sending.request.id() != reply.id()) continue;
    if (status.open && !sending.status.open) client_.open_radio_writer(wire_topic(topic));
    sending.status = status;
  }
  for (auto& [topic, listening] : listenings_) {
    if (listening.request.id() != reply.id()) continue;
    if (status.open && !listening.status.open) {
      const TopicSpec spec =
          radio_topic(arrival_topic(topic, node_), listening.request.type(), topics::kMostRadioSources);
      client_.open_radio_reader(spec,
                                [handler = &listening.handler](Sample&& sample) { (*handler)(std::move(sample)); });
    }
    listening.status = status;
  }
}

bool RadioTopics::write(const std::string& topic, std::span<const std::uint8_t> payload) {
  const auto found = sendings_.find(topic);
  if (found == sendings_.end() || !found->second.status.open || client_.router() != router_) return false;
  return client_.write(wire_topic(topic), payload);
}

}  // namespace skein::bus
