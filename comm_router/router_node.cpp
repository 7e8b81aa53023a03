#include "comm_router/router_node.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "bus/lockstep/names.hpp"
#include "comm_router/link_record.hpp"
#include "comm_router/link_stages.hpp"
#include "core/faults/fault_writer.hpp"
#include "core/topics.hpp"
#include "idl/type_names.hpp"

namespace skein::router {

using bus::LockstepClient;

namespace {

/// A participant that sends for this many steps without being attached is taken for a stranger: it will not join.
constexpr std::uint64_t kStrangerSteps = 20;

bool listed(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
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
      gate_(table_.routes(), scenario.fleet.size() + 1, make_links(scenario, faults, seed, out, unwritten_)),
      declared_routes_(table_.routes().size()),
      sync_(table_.routes()),
      registry_(scenario, table_, endpoints()),
      inbox_(bus.run()),
      world_(bus.join(world_domain(base_domain))),
      client_(*world_, inbox_, std::string(bus::kRouterName)),
      arrivals_(scenario, nodes_) {
  for (const Node node : scenario.nodes()) nodes_.push_back(bus.join(node_domain(base_domain, node)));
  for (const Node node : scenario.nodes()) open_door(node, "");
  open_door(kStationNode, bus::kStationName);
  drop_reader_ = bus::subscribe<msg::Drop>(inbox_, *world_, bus::spec(topics::drop()),
                                           [this](const msg::Drop& drop, bus::ParticipantId source) {
                                             if (source == client_.server()) sync_.on_drop(drop.k(), drop.source());
                                           });
  client_.declare_writer(bus::spec(topics::attached()), LockstepClient::Counterpart::server);
  client_.declare_writer(bus::spec(topics::routed()), LockstepClient::Counterpart::server);
  client_.declare_writer(bus::spec(topics::awaits()), LockstepClient::Counterpart::server);
  client_.answer_again_with([this] {
    if (last_routed_ && last_routed_->k() == client_.step().k()) client_.write(topics::routed().name, *last_routed_);
  });
  client_.declare_when([this] {
    open_radio();
    return true;
  });
}

void RouterNode::open_door(Node node, std::string_view member) {
  const std::size_t door = doors_.size();
  doors_.push_back({node,
                    bus::subscribe<msg::Ready>(inbox_, *nodes_[node], bus::ready_spec(member),
                                               [this, door](const msg::Ready& ready, bus::ParticipantId source) {
                                                 on_ready(door, ready, source);
                                               }),
                    bus::subscribe<msg::Done>(inbox_, *nodes_[node], bus::done_spec(member),
                                              [this](const msg::Done& done, bus::ParticipantId source) {
                                                // Before the invitation, there may be answers to any number of steps.
                                                if (!radio_open_) return;
                                                sync_.on_done(source, done.k(), sent_counts(done));
                                              })});
}

// Called only after the server's invitation. The server stands still until the router is a member, so no message is
// under way, and the members' counts in the invitation are exact.
void RouterNode::open_radio() {
  if (std::exchange(radio_open_, true)) return;
  for (const Node node : scenario_.nodes()) open_requests(node);
  for (std::size_t route = 0; route < table_.routes().size(); ++route) open_route(route);
  for (const auto& base : client_.base()) sync_.set_base(base.source, base.topic, base.count);
}

void RouterNode::open_requests(Node node) {
  const auto queue = [this, node](bus::Sample&& sample) {
    if (from_stranger(node, topics::radio_request().name, sample.source)) return;
    sync_.on_request(sample.source, std::make_shared<const std::vector<std::uint8_t>>(std::move(sample.payload)));
  };
  request_readers_.push_back(
      inbox_.subscribe(*nodes_[node], bus::spec(topics::radio_request()), queue, bus::Bell::silent));
  arrivals_.open_replies(node);
}

void RouterNode::open_route(std::size_t number) {
  const RadioRoute& route = table_.routes()[number];
  if (number == radio_readers_.size()) radio_readers_.emplace_back();
  if (!radio_readers_[number]) {
    const auto queue = [this, number](bus::Sample&& sample) {
      const RadioRoute& of = table_.routes()[number];
      if (from_stranger(of.source, of.topic, sample.source)) return;
      sync_.on_radio(sample.source, number,
                     std::make_shared<const std::vector<std::uint8_t>>(std::move(sample.payload)));
    };
    // Silent: a sample is of no use before the Done that counts it. When all Done are here, rings() waits for samples.
    radio_readers_[number] =
        inbox_.subscribe(*nodes_[route.source], radio_spec(route.topic, route.type), queue, bus::Bell::silent);
  }
  arrivals_.open_route(number, route);
}

// No message ever passed on this route, so the counts can begin at 0 again when it is reopened.
void RouterNode::close_route(std::size_t number) {
  if (number < declared_routes_) return;
  radio_readers_[number].reset();
  arrivals_.close_route(number);
}

// A sender that is not an applicant is a stranger: members are attached before they send.
bool RouterNode::from_stranger(Node node, const std::string& topic, bus::ParticipantId source) {
  if (applicants_.contains(source)) return false;
  const std::string name = scenario_.node_name(node);
  const bool has_stand_in = stand_ins_.contains(name) && (k_ == 0 || present_.contains(name));
  if (!has_stand_in) strangers_.add(name, topic, source, k_);
  return true;
}

void RouterNode::tell_of_strangers(std::uint64_t patience) {
  const auto is_stranger = [this](bus::ParticipantId source) { return !applicants_.contains(source); };
  for (const auto& notice : strangers_.take_notices(k_, patience, is_stranger)) {
    warnings_.push_back(describe(notice));
    spdlog::warn("{}", warnings_.back());
  }
}

std::uint64_t RouterNode::unheard() const {
  std::uint64_t sum = 0;
  for (const Node node : scenario_.nodes()) sum += strangers_.unheard(scenario_.node_name(node));
  return sum;
}

RadioEndpoints RouterNode::endpoints() {
  return {.open = [this](std::size_t route) { open_route(route); },
          .close = [this](std::size_t route) { close_route(route); },
          .hears = [this](std::size_t route,
                          SourceId source) { return bus::contains(radio_readers_[route]->matched(), source); },
          .reaches = [this](const RadioTarget& target, SourceId source) { return arrivals_.reaches(target, source); },
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

void RouterNode::on_ready(std::size_t door, const msg::Ready& ready, bus::ParticipantId source) {
  if (ready.revision() == 0) return;
  applicants_[source] = {ready.member(), doors_[door].node, door, ready.revision(),
                         ready.reads(),  ready.writes(),    false};
}

std::string RouterNode::unmatched(const Applicant& applicant, bus::ParticipantId source) const {
  if (!bus::contains(doors_[applicant.door].done->matched(), source)) return bus::done_spec(applicant.member).name;
  const std::string requests = topics::radio_request().name;
  if (listed(applicant.writes, requests) && !bus::contains(request_readers_[applicant.node]->matched(), source)) {
    return requests;
  }
  const auto& routes = table_.routes();
  for (std::size_t r = 0; r < routes.size(); ++r) {
    if (routes[r].source == applicant.node && listed(applicant.writes, routes[r].topic) && radio_readers_[r] &&
        !bus::contains(radio_readers_[r]->matched(), source)) {
      return routes[r].topic;
    }
  }
  return arrivals_.unmatched(applicant.node, applicant.reads, source);
}

bool RouterNode::attach() {
  if (!radio_open_ || client_.server() == 0) return true;
  bool waiting = false;
  std::erase_if(applicants_, [&](const auto& entry) {
    const auto& [source, applicant] = entry;
    return !applicant.attached && !bus::contains(doors_[applicant.door].ready->matched(), source);  // it left
  });
  for (auto& [source, applicant] : applicants_) {
    if (applicant.attached) continue;
    if (!unmatched(applicant, source).empty()) {
      waiting = true;
      continue;
    }
    auto attached = bus::message_of<msg::Attached>(inbox_.run());
    attached.member(applicant.member);
    attached.source(source);
    attached.revision(applicant.revision);
    attached.router(nodes_[applicant.node]->id());
    client_.write(topics::attached().name, attached);
    applicant.attached = true;
  }
  return waiting;
}

std::vector<msg::Await> RouterNode::awaited() const {
  std::vector<msg::Await> list;
  const auto add = [&](const std::string& member, bus::ParticipantId source, bool joining, const std::string& what) {
    list.emplace_back();
    list.back().member(member);
    list.back().source(source);
    list.back().joining(joining);
    list.back().what(what);
  };
  for (const auto& [source, applicant] : applicants_) {
    if (applicant.attached) continue;
    add(applicant.member, source, true, radio_open_ ? unmatched(applicant, source) + " to match" : "the radio to open");
  }
  for (const AwaitedMember& missing : sync_.awaited())
    add(missing.member.name, missing.member.source, false, missing.what);
  if (!batch_) return list;
  for (const AwaitedRequest& request : registry_.awaited()) {
    add(scenario_.node_name(request.asker.node), request.asker.source, false, request.what);
  }
  return list;
}

void RouterNode::tell_awaited(bool waits) {
  if (!waits) word_patience_.reset();
  if (waits && !word_patience_) word_patience_.emplace(word_patience_s_);
  if (!radio_open_ || !(waits ? word_patience_->over() : told_.has_value())) return;
  std::vector<msg::Await> list = awaited();
  if (told_ == list) return;
  auto message = bus::message_of<msg::Awaits>(inbox_.run());
  message.k(batch_ ? batch_->k : sync_.next_step().value_or(0));
  message.members(list);
  client_.write(topics::awaits().name, message);
  told_ = std::move(list);
}

void RouterNode::begin_step() {
  told_.reset();
  word_patience_.reset();
  const msg::Step& step = client_.step();
  std::vector<RadioMember> members;
  present_.clear();
  for (const auto& member : step.members()) {
    present_.insert(member.name());
    if (member.name() == bus::kRouterName) continue;
    const auto applicant = applicants_.find(member.source());
    if (applicant != applicants_.end()) members.push_back({member.name(), member.source(), applicant->second.node});
  }
  k_ = step.k();
  for (const msg::FaultBegin& begun : step.faults()) gate_.set_off(begun.fault(), begun.tick());
  if (by_hand_ != step.faults_by_hand()) {
    by_hand_ = step.faults_by_hand();
    gate_.set_by_hand(read_faults_by_hand(by_hand_text("", by_hand_), "faults by hand", scenario_));
  }
  tell_of_strangers(step.final_step() ? 0 : kStrangerSteps);
  sync_.on_step(step.k(), step.epoch(), std::move(members), Links(nodes_.size(), step.links()));
  if (step.final_step()) last_k_ = step.k();
}

void RouterNode::deliver(const StepBatch& batch) {
  const GatedStep gated = gate_.gate(batch.k, batch.links, batch.messages);
  if (count_store_) count_store_->save(gate_, gated);
  if (recording_) recording_->add(batch, table_.routes(), gated);
  for (const Delivery& delivery : gated.deliveries) {
    arrivals_.write(delivery.route, delivery.target, *delivery.payload);
  }
  reply();

  auto routed = bus::message_of<msg::Routed>(inbox_.run());
  routed.k(batch.k);
  routed.epoch(batch.epoch);
  routed.nodes(arrivals_.take_delivered());
  routed.digest(gated.digest);
  routed.decided_by_clock(registry_.decided_by_clock());
  client_.write(topics::routed().name, routed);
  last_routed_ = std::move(routed);
  last_step_answered_ = batch.k == last_k_;
}

// Replies are counted like radio messages, but they are none: they need no link, and are in no digest.
void RouterNode::reply() {
  for (const RadioReply& answer : registry_.end_step()) {
    if (!answer.reason.empty()) {
      spdlog::warn("a radio topic of {} is refused: {}", scenario_.node_name(answer.asker.node), answer.reason);
    }
    auto message = bus::message_of<msg::RadioReply>(inbox_.run());
    message.asker(answer.asker.source);
    message.id(answer.asker.id);
    message.open(answer.open);
    message.reason(answer.reason);
    message.unheard(answer.unheard);
    arrivals_.write_reply(answer.asker.node, encode(message));
  }
}

std::vector<RadioRequest> RouterNode::read_requests(const StepBatch& batch) {
  std::vector<RadioRequest> requests;
  for (const RequestSample& sample : batch.requests) {
    msg::RadioRequest message;
    if (!decode(*sample.payload, message) || RunId{message.run()} != inbox_.run()) {
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

void RouterNode::record_with(recording::Recorder& recorder) {
  recording_.emplace(scenario_, recorder);
  arrivals_.record_with(recorder);
  client_.before_obeying([this] { recording_->flush(); });
}

void RouterNode::replay(const recording::ReplayOptions& options) {
  replay_ = std::make_unique<ReplayNode>(scenario_, table_.routes(), options);
}

std::optional<std::vector<std::string>> RouterNode::differences() const {
  return replay_ ? std::optional(replay_->differences().texts()) : std::nullopt;
}

void RouterNode::tell_of_excesses() {
  for (const Excess& excess : sync_.take_excesses()) {
    const auto applicant = applicants_.find(excess.source);
    warnings_.push_back((applicant == applicants_.end() ? "a program" : applicant->second.member) + " " + excess.what);
    spdlog::warn("{}", warnings_.back());
  }
}

bool RouterNode::serve() {
  const bool matches = advance();
  tell_of_excesses();
  tell_awaited(matches || batch_ || sync_.waiting());
  return matches;
}

bool RouterNode::advance() {
  const bool waiting = attach();
  for (;;) {
    if (!batch_) {
      batch_ = sync_.take();
      if (!batch_) return waiting;
      registry_.begin_step(read_requests(*batch_));
      match_patience_ = bus::Patience(match_patience_s_);
    }
    if (registry_.waiting() && !match_patience_.over()) return true;
    if (replay_) replay_->replace(*batch_);
    deliver(*batch_);
    batch_.reset();
  }
}

std::size_t RouterNode::rings() { return sync_.waiting() ? sync_.missing_answers() : client_.rings(); }

void RouterNode::set_patience(double match_s, double word_s) {
  match_patience_s_ = match_s;
  word_patience_s_ = word_s;
}

std::string RouterNode::waiting_for() {
  std::string text = "comm_router: " + client_.waiting_for() + ";";
  for (const msg::Await& await : awaited()) text += " " + await.member() + ": " + await.what() + ";";
  return text;
}

}  // namespace skein::router
