#include "bus/lockstep/server.hpp"

#include <algorithm>
#include <utility>

#include "bus/lockstep/names.hpp"

namespace skein::bus {

namespace {

std::string describe(const CountedQueues::Surplus& surplus, bool was_cut_off) {
  const std::string counts = std::to_string(surplus.arrived) + " samples on " + surplus.topic + ", " +
                             std::to_string(surplus.announced) + " announced by its done";
  if (was_cut_off) return "samples that it had sent arrived twice: " + counts;
  return "sent more than it announced: " + counts + " (docs/lockstep.md, \"Rules for a client\")";
}

/// A participant whose lease expired and that comes back is a new one for DDS: it misses the samples that were sent
/// meanwhile, and the samples that its writers keep are delivered again.
constexpr const char* kCutOff =
    "; the network was cut for longer than its lease, and it is back since (docs/lockstep.md, \"Waiting\")";

}  // namespace

LockstepServer::DomainIndex LockstepServer::add_domain(const std::string& node, Participant& participant) {
  const DomainIndex index = domains_.size();
  auto domain = std::make_unique<Domain>();
  domain->node = node;
  domain->participant = &participant;
  domain->step = std::make_unique<CountedWriter>(participant, spec(topics::step()));
  domain->resync = std::make_unique<CountedWriter>(participant, spec(topics::resync()));
  if (index == 0) {
    const TopicSpec routed = spec(topics::routed()), attached = spec(topics::attached()),
                    awaits = spec(topics::awaits());
    domain->readers.emplace_back(
        routed.name, subscribe<msg::Routed>(inbox_, participant, routed,
                                            [this](const auto& m, ParticipantId source) { on_routed(m, source); }));
    domain->readers.emplace_back(attached.name, subscribe<msg::Attached>(inbox_, participant, attached,
                                                                         [this](const auto& m, ParticipantId source) {
                                                                           attached_[{source, m.source()}] = m.router();
                                                                         }));
    domain->readers.emplace_back(
        awaits.name, subscribe<msg::Awaits>(inbox_, participant, awaits,
                                            [this](auto& m, ParticipantId source) { on_awaits(m, source); }));
    drop_ = std::make_unique<CountedWriter>(participant, spec(topics::drop()));
  }
  domains_.push_back(std::move(domain));
  open_door(index, "");
  return index;
}

std::size_t LockstepServer::open_door(DomainIndex domain, std::string_view member) {
  Domain& d = *domains_.at(domain);
  const std::size_t door = d.doors.size();
  d.doors.push_back({subscribe<msg::Ready>(inbox_, *d.participant, ready_spec(member),
                                           [this, domain, door](const msg::Ready& ready, ParticipantId source) {
                                             on_ready(domain, door, ready, source);
                                           }),
                     subscribe<msg::Done>(inbox_, *d.participant, done_spec(member),
                                          [this, domain, door](const msg::Done& done, ParticipantId source) {
                                            on_done(domain, door, done, source);
                                          })});
  return door;
}

void LockstepServer::add_place(const std::string& member, DomainIndex domain, bool awaited) {
  Place place;
  place.name = member;
  place.domain = domain;
  if (member == kStationName) place.door = open_door(domain, member);
  place.awaited = awaited;
  places_.push_back(std::move(place));
}

CountedWriter& LockstepServer::writer(DomainIndex domain, const TopicSpec& topic) {
  Domain& d = *domains_.at(domain);
  d.writers.push_back(std::make_unique<CountedWriter>(*d.participant, topic, tap_ ? tap_->ear(d.node, topic) : Ear{}));
  d.announced.push_back(0);
  return *d.writers.back();
}

void LockstepServer::read(DomainIndex domain, const TopicSpec& topic, CountedQueues::Handler handler) {
  Domain& d = *domains_.at(domain);
  if (tap_) handler = tap_->taken(d.node, topic, std::move(handler));
  d.commands.add_topic(topic.name, std::move(handler));
  const auto queue = [this, domain, &d, name = topic.name](Sample&& s) {
    // Any program may write in this domain. Only a program that has said hello can become a member: ignore all others.
    const bool known =
        std::any_of(places_.begin(), places_.end(), [&](const Place& p) { return p.source == s.source; });
    if (known)
      d.commands.arrive(name, std::move(s));
    else if (on_stranger_)
      on_stranger_(domain, name, s.source);
  };
  // Silent: samples are of no use before the Done that announces them. After all Dones, rings() is 0: any sample wakes.
  d.readers.emplace_back(topic.name, inbox_.subscribe(*d.participant, topic, queue, Bell::silent));
}

bool LockstepServer::is_stranger(ParticipantId source) const {
  return !gone_.contains(source) && std::none_of(places_.begin(), places_.end(), [&](const Place& p) {
    return p.source == source || (p.next && p.next->first == source);
  });
}

LockstepServer::Place* LockstepServer::find(std::string_view name) {
  const auto it = std::find_if(places_.begin(), places_.end(), [&](const Place& p) { return p.name == name; });
  return it == places_.end() ? nullptr : &*it;
}

const LockstepServer::Place* LockstepServer::router() const {
  const auto it =
      std::find_if(places_.begin(), places_.end(), [](const Place& p) { return p.name == kRouterName && p.member; });
  return it == places_.end() ? nullptr : &*it;
}

bool LockstepServer::is_member(const std::string& name) const {
  return std::any_of(places_.begin(), places_.end(), [&](const Place& p) { return p.name == name && p.member; });
}

// ---- one step ---------------------------------------------------------------------------------------------------

std::vector<msg::TopicCount> LockstepServer::all_counts(const Domain& domain) const {
  std::vector<msg::TopicCount> result;
  for (const auto& writer : domain.writers) {
    result.push_back(topic_count(writer->topic(), domain.participant->id(), writer->count()));
  }
  const auto delivered = delivered_.find(domain.node);
  if (delivered != delivered_.end()) {
    for (const auto& [topic, count] : delivered->second) result.push_back(count);
  }
  return result;
}

std::vector<msg::TopicCount> LockstepServer::take_new_counts(Domain& domain) {
  std::vector<msg::TopicCount> result;
  for (std::size_t i = 0; i < domain.writers.size(); ++i) {
    const CountedWriter& writer = *domain.writers[i];
    // DDS sends latched samples to a newcomer again, which waits for them only if the step announces them.
    const bool repeated = domain.newcomer && writer.latched() && writer.count() > 0;
    if (writer.count() == domain.announced[i] && !repeated) continue;
    domain.announced[i] = writer.count();
    result.push_back(topic_count(writer.topic(), domain.participant->id(), writer.count()));
  }
  domain.newcomer = false;
  if (const auto fresh = newly_delivered_.extract(domain.node)) {
    result.insert(result.end(), fresh.mapped().begin(), fresh.mapped().end());
  }
  return result;
}

// Participant of a member as its peers in a domain see it: the router has a participant of its own in each domain.
ParticipantId LockstepServer::source_in(DomainIndex domain, const Place& member) const {
  if (domain == 0 || member.name != kRouterName) return member.source;
  for (const Place& peer : places_) {
    if (!peer.member || peer.domain != domain) continue;
    const auto attached = attached_.find({member.source, peer.source});
    if (attached != attached_.end()) return attached->second;
  }
  return 0;
}

void LockstepServer::publish(const StepInfo& info, const WriteSamples& write_samples) {
  if (membership_changed_) ++epoch_;
  membership_changed_ = false;
  in_step_ = true;
  k_ = info.k;
  routed_digest_.clear();
  station_digest_.clear();
  awaits_ = {};
  auto step = message_of<msg::Step>(inbox_.run());
  step.k(info.k);
  step.epoch(epoch_);
  step.tick(info.tick);
  const std::int64_t ns = info.tick * 2'500'000;
  step.stamp().sec(static_cast<std::int32_t>(ns / 1'000'000'000));
  step.stamp().nanosec(static_cast<std::uint32_t>(ns % 1'000'000'000));
  step.ledger_upto(info.ledger_upto);
  step.final_step(info.final_step);
  for (std::size_t i = 0; i < domains_.size(); ++i) {
    Domain& domain = *domains_[i];
    const Burst burst(*domain.participant);
    write_samples(i);
    step.members().clear();
    step.orders().clear();
    for (Place& place : places_) {
      place.answered = false;
      // In each step: a slow member may miss the first step with the order, when the topic's history has moved on.
      if (place.order && place.domain == i) step.orders().push_back(*place.order);
      if (!place.member || (i != 0 && place.domain != i && place.name != kRouterName)) continue;
      msg::Member member;
      member.name(place.name);
      member.source(source_in(i, place));
      step.members().push_back(member);
    }
    step.expected(take_new_counts(domain));
    step.links(i == 0 ? info.links : std::vector<std::uint8_t>{});
    step.faults(i == 0 ? info.faults : std::vector<msg::FaultBegin>{});
    step.faults_by_hand(i == 0 ? info.faults_by_hand : std::vector<std::string>{});
    for (auto& writer : domain.writers) writer->begin_step();
    domain.step->begin_step();
    domain.step->write(step);
    domain.last = step;
  }
}

// The router died within a step: its outstanding deliveries will never come, so members must not wait for them.
void LockstepServer::amend_step() {
  for (std::size_t i = 1; i < domains_.size(); ++i) {
    Domain& domain = *domains_[i];
    std::erase_if(domain.last.members(), [](const msg::Member& m) { return m.name() == kRouterName; });
    std::erase_if(domain.last.expected(),
                  [&](const msg::TopicCount& c) { return c.source() != domain.participant->id(); });
    domain.step->write(domain.last);
  }
}

void LockstepServer::on_done(DomainIndex domain, std::size_t door, const msg::Done& done, ParticipantId source) {
  if (!in_step_) return;
  Place* place = find(done.member());
  if (place == nullptr || !place->member || place->domain != domain || place->door != door || place->source != source ||
      done.k() != k_ || done.epoch() != epoch_) {
    return;
  }
  place->sent.clear();
  for (const auto& sent : done.sent()) place->sent.push_back({sent.topic(), source, sent.count()});
  place->answered = true;
  if (place->name == kStationName) station_digest_ = done.digest();
}

void LockstepServer::on_routed(const msg::Routed& routed, ParticipantId source) {
  Place* place = find(kRouterName);
  if (!in_step_ || place == nullptr || !place->member || place->source != source || place->answered ||
      routed.k() != k_ || routed.epoch() != epoch_) {
    return;
  }
  for (const auto& node : routed.nodes()) {
    for (const auto& count : node.delivered()) delivered_[node.node()][count.topic()] = count;
    newly_delivered_[node.node()] = node.delivered();
  }
  routed_digest_ = routed.digest();
  doubts_.insert(doubts_.end(), routed.decided_by_clock().begin(), routed.decided_by_clock().end());
  place->answered = true;
}

void LockstepServer::on_awaits(msg::Awaits& awaits, ParticipantId source) {
  const Place* place = find(kRouterName);  // it may report before it is a member
  if (place != nullptr && place->source == source) awaits_ = std::move(awaits);
}

bool LockstepServer::answered() {
  if (!in_step_) return false;
  for (std::size_t i = 0; i < domains_.size(); ++i) {
    std::vector<CountedQueues::Expected> expected;
    for (const Place& place : places_) {
      if (!place.member || place.domain != i) continue;
      if (!place.answered) return false;
      expected.insert(expected.end(), place.sent.begin(), place.sent.end());
    }
    domains_[i]->commands.expect(expected);
  }
  for (const auto& domain : domains_) {
    if (!domain->commands.complete()) return false;
  }
  in_step_ = false;
  for (Place& place : places_) {
    if (!place.member) continue;
    if (const auto surplus = domains_[place.domain]->commands.surplus(place.source)) {
      leave(place, describe(*surplus, place.unheard));
    }
  }
  for (const auto& domain : domains_) domain->commands.release();
  return true;
}

bool LockstepServer::is_heard(const Place& place) const {
  return contains(door_of(place).ready->matched(), place.source);
}

void LockstepServer::ask_again() {
  for (Place& place : places_) place.unheard = place.unheard || (in_step_ && place.member && !is_heard(place));
  for (std::size_t i = 0; in_step_ && i < domains_.size(); ++i) {
    Domain& domain = *domains_[i];
    const bool silent = std::any_of(places_.begin(), places_.end(),
                                    [&](const Place& p) { return p.member && p.domain == i && !p.answered; });
    if (!silent) continue;
    domain.step->begin_step();
    domain.step->write(domain.last);
  }
}

std::size_t LockstepServer::rings() const {
  return static_cast<std::size_t>(
      std::count_if(places_.begin(), places_.end(), [](const Place& p) { return p.member && !p.answered; }));
}

// ---- leaving ----------------------------------------------------------------------------------------------------

void LockstepServer::vacate(Place& place) {
  place.member = place.invited = place.declared = place.answered = place.unheard = false;
  place.source = 0;
  place.sent.clear();
}

void LockstepServer::leave(Place& place, const std::string& reason) {
  domains_[place.domain]->commands.discard(place.source);
  if (place.member) {
    membership_changed_ = true;
    auto drop = message_of<msg::Drop>(inbox_.run());
    drop.k(k_);
    drop.epoch(epoch_);
    drop.member(place.name);
    drop.source(place.source);
    drop_->begin_step();
    drop_->write(drop);
  }
  const bool was_cut_off = place.unheard && is_heard(place);
  lost_.push_back({place.name, k_, was_cut_off ? reason + kCutOff : reason});
  place.was_lost = true;
  std::erase(rejoined_, place.name);
  if (place.source != 0) gone_.insert(place.source);
  place.awaited = false;
  place.order.reset();
  vacate(place);
  if (place.name == kRouterName) {
    forget_deliveries();
    if (in_step_) amend_step();
  }
}

// The router's last deliveries are lost with it: no program could repeat those that have not arrived.
void LockstepServer::forget_deliveries() {
  delivered_.clear();
  newly_delivered_.clear();
}

bool LockstepServer::take_out(const std::string& member, std::string_view order) {
  Place* place = find(member);
  if (place == nullptr || !place->member) return false;
  domains_[place->domain]->commands.discard(place->source);
  gone_.insert(place->source);
  msg::Order& told = place->order.emplace();
  told.member(member);
  told.source(place->source);
  told.order(std::string(order));
  membership_changed_ = true;
  vacate(*place);
  if (place->name == kRouterName) forget_deliveries();
  return true;
}

bool LockstepServer::let_back(const std::string& member) {
  Place* place = find(member);
  if (place == nullptr || !place->order) return false;
  place->order.reset();
  place->awaited = true;
  return true;
}

void LockstepServer::lost(const std::string& member, const std::string& reason) {
  Place* place = find(member);
  if (place == nullptr) return;
  if (place->source == 0 && !place->awaited && !place->order) return;
  leave(*place, reason);
}

void LockstepServer::drop_vanished() {
  for (Place& place : places_) {
    if (place.member && !is_heard(place)) {
      leave(place, "it has left, or gives no sign of life");
    }
  }
}

std::vector<LockstepServer::LostMember> LockstepServer::take_lost() { return std::exchange(lost_, {}); }

std::vector<std::string> LockstepServer::take_rejoined() { return std::exchange(rejoined_, {}); }

std::vector<std::string> LockstepServer::take_doubts() { return std::exchange(doubts_, {}); }

}  // namespace skein::bus
