#include "comm_router/router_node.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "bus/lockstep/names.hpp"
#include "comm_router/link_record.hpp"
#include "comm_router/link_stages.hpp"
#include "core/topics.hpp"
#include "idl/type_names.hpp"

namespace skein::router {

using bus::LockstepClient;

namespace {

/// How long the world stands still for a member that registers a topic and has no fitting writer of it, by a wall
/// clock. Discovery takes milliseconds; who gets here has made a mistake, and is told so.
constexpr std::chrono::seconds kMatchPatience{10};

bool listed(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bus::TopicSpec radio_spec(const std::string& topic, const std::string& type, std::size_t sources = 1) {
  return {topic, type, bus::Qos{.reliable = true, .latched = false, .depth = topics::radio_depth(sources)}};
}

std::vector<SentCount> sent_counts(const msg::Done& done) {
  std::vector<SentCount> counts;
  for (const auto& sent : done.sent()) counts.push_back({sent.topic(), sent.count()});
  return counts;
}

std::unique_ptr<LinkModel> make_links(const Scenario& scenario, const FaultPlan& faults, std::uint64_t seed,
                                      const std::filesystem::path& out, std::vector<std::string>& unwritten) {
  auto links = std::make_unique<LinkStages>(scenario, faults, seed);
  if (out.empty()) return links;
  return std::make_unique<LinkRecord>(std::move(links), scenario, out, unwritten);
}

}  // namespace

RouterNode::RouterNode(const Scenario& scenario, std::uint64_t seed, int base_domain, bus::Bus& bus,
                       const FaultPlan& faults, const std::filesystem::path& out)
    : scenario_(scenario),
      table_(scenario),
      gate_(table_.routes(), scenario.fleet.size() + 1,
            make_links(scenario, faults, seed, out, unwritten_)),
      sync_(gate_.routes()),
      registry_(scenario, table_, endpoints()),
      world_(bus.join(world_domain(base_domain))),
      client_(*world_, inbox_, std::string(bus::kRouterName)) {
  for (Node node = 0; node < gate_.nodes(); ++node) nodes_.push_back(bus.join(node_domain(base_domain, node)));
  for (Node node = 0; node < gate_.nodes(); ++node) {
    done_readers_.push_back(
        bus::subscribe<msg::Done>(inbox_, *nodes_[node], bus::spec(topics::done()),
                                  [this](const msg::Done& done, bus::ParticipantId source) {
                                    sync_.on_done(source, done.k(), sent_counts(done));
                                  }));
    ready_readers_.push_back(bus::subscribe<msg::Ready>(
        inbox_, *nodes_[node], bus::spec(topics::ready()),
        [this, node](const msg::Ready& ready, bus::ParticipantId source) { on_ready(node, ready, source); }));
  }
  drop_reader_ = bus::subscribe<msg::Drop>(inbox_, *world_, bus::spec(topics::drop()),
                                           [this](const msg::Drop& drop, bus::ParticipantId source) {
                                             if (source == client_.server()) sync_.on_drop(drop.k(), drop.source());
                                           });
  client_.declare_writer(bus::spec(topics::attached()), LockstepClient::Counterpart::server);
  client_.declare_writer(bus::spec(topics::routed()), LockstepClient::Counterpart::server);
  client_.declare_when([this] {
    open_radio();
    return true;
  });
}

// Only after the server's invitation: it stands still until we are a member, so no message is under way, and the
// members' counts that it told us are exact.
void RouterNode::open_radio() {
  if (std::exchange(radio_open_, true)) return;
  for (Node node = 0; node < gate_.nodes(); ++node) open_requests(node);
  for (std::size_t route = 0; route < gate_.routes().size(); ++route) open_route(route);
  for (const auto& base : client_.base()) sync_.set_base(base.source, base.topic, base.count);
}

void RouterNode::open_requests(Node node) {
  const auto queue = [this](bus::Sample&& sample) {
    sync_.on_request(sample.source, std::make_shared<const std::vector<std::uint8_t>>(std::move(sample.payload)));
  };
  request_readers_.push_back(
      inbox_.subscribe(*nodes_[node], bus::spec(topics::radio_request()), queue, bus::Bell::silent));
  const bus::TopicSpec replies = bus::spec(topics::radio_reply());
  replies_of_.push_back(arrivals_.size());
  arrivals_.push_back({node, replies.name, std::make_unique<bus::CountedWriter>(*nodes_[node], replies)});
}

void RouterNode::open_route(std::size_t number) {
  const RadioRoute& route = gate_.routes()[number];
  if (number == radio_readers_.size()) {
    const auto queue = [this, number](bus::Sample&& sample) {
      sync_.on_radio(sample.source, number,
                     std::make_shared<const std::vector<std::uint8_t>>(std::move(sample.payload)));
    };
    // Of no use before the Done that counts them; once all of those are here, rings() waits for any sample.
    radio_readers_.push_back(inbox_.subscribe(*nodes_[route.source], radio_spec(route.topic, route.type), queue,
                                              bus::Bell::silent));
    arrival_of_.emplace_back();
  }
  for (std::size_t t = arrival_of_[number].size(); t < route.targets.size(); ++t) {
    arrival_of_[number].push_back(find_or_open_arrival(route.targets[t], route.type));
  }
}

RadioEndpoints RouterNode::endpoints() {
  const auto arrival_at = [this](const RadioTarget& target) {
    return std::find_if(arrivals_.begin(), arrivals_.end(),
                        [&](const Arrival& a) { return a.node == target.node && a.topic == target.topic; });
  };
  return {.open =
              [this](std::size_t route) {
                gate_.put(route, table_.routes()[route]);
                open_route(route);
              },
          .hears = [this](std::size_t route,
                          SourceId source) { return bus::contains(radio_readers_[route]->matched(), source); },
          .reaches =
              [this, arrival_at](const RadioTarget& target, SourceId source) {
                const auto arrival = arrival_at(target);
                return arrival != arrivals_.end() && arrival->writer->matches(source);
              },
          .declared =
              [this](const RadioTarget& target) {
                return std::any_of(applicants_.begin(), applicants_.end(), [&](const auto& entry) {
                  const auto& [source, applicant] = entry;
                  return applicant.attached && applicant.node == target.node && listed(applicant.reads, target.topic) &&
                         !sync_.lost(source);
                });
              },
          .admit = [this](std::size_t route, SourceId source) { sync_.open(source, route); },
          .lost = [this](SourceId source) { return sync_.lost(source); }};
}

std::size_t RouterNode::find_or_open_arrival(const RadioTarget& target, const std::string& type) {
  const auto found = std::find_if(arrivals_.begin(), arrivals_.end(),
                                  [&](const Arrival& a) { return a.node == target.node && a.topic == target.topic; });
  if (found == arrivals_.end()) {
    arrivals_.push_back(
        {target.node, target.topic,
         std::make_unique<bus::CountedWriter>(*nodes_[target.node], radio_spec(target.topic, type, gate_.nodes()))});
    return arrivals_.size() - 1;
  }
  return static_cast<std::size_t>(found - arrivals_.begin());
}

void RouterNode::on_ready(Node node, const msg::Ready& ready, bus::ParticipantId source) {
  if (ready.revision() == 0) return;
  applicants_[source] = {ready.member(), node, ready.revision(), ready.reads(), ready.writes(), false};
}

bool RouterNode::endpoints_match(const Applicant& applicant, bus::ParticipantId source) const {
  if (!bus::contains(done_readers_[applicant.node]->matched(), source)) return false;
  if (listed(applicant.writes, topics::radio_request().name) &&
      !bus::contains(request_readers_[applicant.node]->matched(), source)) {
    return false;
  }
  const auto& routes = gate_.routes();
  for (std::size_t r = 0; r < routes.size(); ++r) {
    if (routes[r].source == applicant.node && listed(applicant.writes, routes[r].topic) &&
        !bus::contains(radio_readers_[r]->matched(), source)) {
      return false;
    }
  }
  return std::all_of(arrivals_.begin(), arrivals_.end(), [&](const Arrival& arrival) {
    return arrival.node != applicant.node || !listed(applicant.reads, arrival.topic) || arrival.writer->matches(source);
  });
}

bool RouterNode::attach() {
  if (!radio_open_ || client_.server() == 0) return true;
  bool waiting = false;
  std::erase_if(applicants_, [&](const auto& entry) {
    const auto& [source, applicant] = entry;
    return !applicant.attached && !bus::contains(ready_readers_[applicant.node]->matched(), source);  // it left
  });
  for (auto& [source, applicant] : applicants_) {
    if (applicant.attached) continue;
    if (!endpoints_match(applicant, source)) {
      waiting = true;
      continue;
    }
    msg::Attached attached;
    attached.member(applicant.member);
    attached.source(source);
    attached.revision(applicant.revision);
    attached.router(nodes_[applicant.node]->id());
    client_.write(topics::attached().name, attached);
    applicant.attached = true;
  }
  return waiting;
}

void RouterNode::begin_step() {
  const msg::Step& step = client_.step();
  std::vector<RadioMember> members;
  for (const auto& member : step.members()) {
    if (member.name() == bus::kRouterName) continue;
    const auto applicant = applicants_.find(member.source());
    if (applicant != applicants_.end()) members.push_back({member.name(), member.source(), applicant->second.node});
  }
  sync_.on_step(step.k(), step.epoch(), std::move(members), step.links());
  if (step.final_step()) last_k_ = step.k();
}

void RouterNode::deliver(const StepBatch& batch) {
  const GatedStep gated = gate_.gate(batch.k, batch.links, batch.messages);
  if (count_store_) count_store_->save(gate_, gated);
  Delivered delivered;
  for (const Delivery& delivery : gated.deliveries) {
    write_arrival(arrival_of_[delivery.route][delivery.target], *delivery.payload, delivered);
  }
  reply(delivered);

  msg::Routed routed;
  routed.k(batch.k);
  routed.epoch(batch.epoch);
  for (const auto& [node, counts] : delivered) {
    msg::NodeCounts entry;
    entry.node(scenario_.node_name(node));
    for (const auto& [index, total] : counts) {
      msg::TopicCount count;
      count.topic(arrivals_[index].topic);
      count.source(nodes_[node]->id());
      count.count(total);
      entry.delivered().push_back(count);
    }
    routed.nodes().push_back(std::move(entry));
  }
  routed.digest(gated.digest);
  client_.write(topics::routed().name, routed);
  last_step_answered_ = batch.k == last_k_;
}

void RouterNode::write_arrival(std::size_t index, std::span<const std::uint8_t> payload, Delivered& delivered) {
  Arrival& arrival = arrivals_[index];
  const auto [entry, first] = delivered[arrival.node].try_emplace(index, 0);
  if (first) arrival.writer->begin_step();
  arrival.writer->write(payload);
  entry->second = arrival.writer->count();
}

// Replies are counted like what arrives by radio, but are none: they need no link, and are in no digest.
void RouterNode::reply(Delivered& delivered) {
  for (const RadioReply& answer : registry_.end_step()) {
    if (!answer.reason.empty()) {
      spdlog::warn("a radio topic of {} is refused: {}", scenario_.node_name(answer.asker.node), answer.reason);
    }
    msg::RadioReply message;
    message.asker(answer.asker.source);
    message.id(answer.asker.id);
    message.open(answer.open);
    message.reason(answer.reason);
    message.unheard(answer.unheard);
    write_arrival(replies_of_[answer.asker.node], encode(message), delivered);
  }
}

std::vector<RadioRequest> RouterNode::read_requests(const StepBatch& batch) {
  std::vector<RadioRequest> requests;
  for (const RequestSample& sample : batch.requests) {
    msg::RadioRequest message;
    if (!decode(*sample.payload, message)) {
      inbox_.note_malformed(topics::radio_request().name, {*sample.payload, sample.source});
      continue;
    }
    requests.push_back({.asker = {sample.source, sample.node, message.id()},
                        .listen = message.listen(),
                        .source = message.source(),
                        .targets = message.targets(),
                        .name = message.name(),
                        .type = message.type()});
  }
  return requests;
}

void RouterNode::keep_counts(CountStore& store) {
  count_store_ = &store;
  gate_.restore(store.earlier_counts());
}

bool RouterNode::serve() {
  const bool waiting = attach();
  for (;;) {
    if (!batch_) {
      batch_ = sync_.take();
      if (!batch_) return waiting;
      registry_.begin_step(read_requests(*batch_));
      patience_end_ = std::chrono::steady_clock::now() + kMatchPatience;
    }
    if (registry_.waiting() && std::chrono::steady_clock::now() < patience_end_) return true;
    deliver(*batch_);
    batch_.reset();
  }
}

std::size_t RouterNode::rings() const { return sync_.waiting() ? sync_.missing_answers() : client_.rings(); }

void RouterNode::poll() {
  if (!attaching_ && !client_.waits_for_matches() && !inbox_.ready(rings())) return;
  inbox_.dispatch(std::chrono::milliseconds(0));
  if (client_.poll() == LockstepClient::Event::think) begin_step();
  attaching_ = serve();
}

std::string RouterNode::waiting_for() const {
  std::string text = "comm_router: " + client_.waiting_for() + ";";
  for (const std::string& missing : sync_.waiting_for()) text += " " + missing + ";";
  return batch_ ? text + " radio topics to match" : text;
}

std::optional<int> RouterNode::run(const StopSignal& stop) {
  const bus::ClientLoop loop{.think = [this] { begin_step(); },
                             .serve = [this] { return serve(); },
                             .rings = [this] { return rings(); },
                             .answered_last = [this] { return last_step_answered_; }};
  const bus::LoopEnd end = bus::run_client(client_, inbox_, loop, stop);
  return end == bus::LoopEnd::resumed ? std::nullopt : std::optional(bus::exit_code(end, "comm_router"));
}

}  // namespace skein::router
