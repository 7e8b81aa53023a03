#include "bus/lockstep/client.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "bus/lockstep/names.hpp"
#include "bus/lockstep/self_signal.hpp"

namespace skein::bus {

namespace {

void raise_on_ourselves(LockstepClient::Order order) {
  const bool kill = order == LockstepClient::Order::kill;
  spdlog::info("a fault {} this program", kill ? "kills" : "stops");
  if (kill) kill_ourselves();
  stop_ourselves();
}

}  // namespace

LockstepClient::LockstepClient(Participant& participant, Inbox& inbox, std::string member)
    : participant_(participant), inbox_(inbox), member_(std::move(member)), obey_(raise_on_ourselves) {
  answer_again_ = [this] {
    if (!last_done_ || last_done_->k() != step_->k()) return;
    done_->begin_step();
    done_->write(*last_done_);
  };
}

void LockstepClient::read(const TopicSpec& topic, Counterpart counterpart, CountedQueues::Handler handler) {
  queues_.add_topic(topic.name, std::move(handler));
  readings_.push_back({topic, counterpart, nullptr});
}

void LockstepClient::declare_writer(const TopicSpec& topic, Counterpart counterpart) {
  writings_.push_back({topic, counterpart, nullptr});
}

void LockstepClient::start() {
  resync_reader_ =
      subscribe<msg::Resync>(inbox_, participant_, spec(topics::resync()),
                             [this](const msg::Resync& resync, ParticipantId source) { on_resync(resync, source); });
  step_reader_ = subscribe<msg::Step>(inbox_, participant_, spec(topics::step()),
                                      [this](msg::Step& step, ParticipantId source) { on_step(step, source); });
  done_ = std::make_unique<CountedWriter>(participant_, done_spec(member_));
  ready_ = std::make_unique<CountedWriter>(participant_, ready_spec(member_));
  phase_ = Phase::hello;
  say_ready(0);
}

void LockstepClient::on_resync(const msg::Resync& resync, ParticipantId source) {
  if (phase_ != Phase::hello || resync.source() != participant_.id()) return;
  server_ = source;
  if (resync.epoch() > 0) invited_after_ = resync.k();
  for (const auto& base : resync.base()) base_.push_back({base.topic(), base.source(), base.count()});
  create_endpoints();
  phase_ = Phase::matching;
}

// Data endpoints are created only now: the server pauses until this program is a member, so no samples are in flight on
// them, and the base counts in the invitation are exact.
void LockstepClient::create_endpoints() {
  for (Reading& reading : readings_) open_reader(reading);
  for (Writing& writing : writings_) writing.writer = std::make_unique<CountedWriter>(participant_, writing.topic);
  for (const auto& base : base_) {
    const auto reading =
        std::find_if(readings_.begin(), readings_.end(), [&](const Reading& r) { return r.topic.name == base.topic; });
    if (reading == readings_.end()) continue;
    // The reader will receive latched samples again, up to the history depth, so the base excludes these.
    const auto depth = static_cast<std::uint64_t>(reading->topic.qos.depth);
    const std::uint64_t repeated = reading->topic.qos.latched ? std::min(base.count, depth) : 0;
    queues_.set_base(base.topic, base.source, base.count - repeated);
  }
}

void LockstepClient::open_reader(Reading& reading) {
  const auto queue = [this, name = reading.topic.name, counterpart = reading.counterpart](Sample&& s) {
    // The router delivers only after this program has answered a step that names the router, so router_ is known.
    if (s.source == (counterpart == Counterpart::server ? server_ : router_)) queues_.arrive(name, std::move(s));
  };
  // Silent: samples are of no use before the step that announces them. After that step, rings() is 0: any sample wakes.
  reading.reader = inbox_.subscribe(participant_, reading.topic, queue, Bell::silent);
}

void LockstepClient::add_radio_writer(const TopicSpec& topic) {
  const auto same = std::find_if(writings_.begin(), writings_.end(),
                                 [&](const Writing& writing) { return writing.topic.name == topic.name; });
  if (same == writings_.end()) {
    writings_.push_back(
        {topic, Counterpart::router, std::make_unique<CountedWriter>(participant_, topic), true, false});
  } else if (same->registered && !same->open && same->topic.type != topic.type) {
    same->writer.reset();  // first: a participant has one type for a topic
    same->topic = topic;
    same->writer = std::make_unique<CountedWriter>(participant_, topic);
  }
}

void LockstepClient::open_radio_writer(const std::string& topic) {
  for (Writing& writing : writings_) writing.open = writing.open || writing.topic.name == topic;
  matched_router_ = 0;
}

// Creates the reader only now, when all deliveries that the current step announces are over: a volatile reader gets
// none of them.
void LockstepClient::open_radio_reader(const TopicSpec& topic, CountedQueues::Handler handler) {
  queues_.add_topic(topic.name, std::move(handler));
  queues_.set_base(topic.name, router_, delivered_[topic.name]);
  const auto former = std::find_if(readings_.begin(), readings_.end(), [&](const Reading& reading) {
    return reading.registered && reading.topic.name == topic.name;
  });
  if (former != readings_.end()) readings_.erase(former);  // with both, each sample would count twice
  readings_.push_back({topic, Counterpart::router, nullptr, true});
  open_reader(readings_.back());
  matched_router_ = 0;
}

// Forgets the radio topics that were registered with the previous router: a new one does not know them.
void LockstepClient::change_router(ParticipantId router) {
  queues_.discard(router_);
  delivered_.clear();
  for (const Reading& reading : readings_) {
    if (reading.registered) queues_.remove_topic(reading.topic.name);
  }
  std::erase_if(readings_, [](const Reading& reading) { return reading.registered; });
  for (Writing& writing : writings_) writing.open = writing.open && !writing.registered;
  router_ = router;
  for (const auto& base : base_) {
    if (base.source == router) delivered_[base.topic] = base.count;
  }
}

void LockstepClient::say_ready(std::uint32_t revision) {
  auto ready = message_of<msg::Ready>(inbox_.run());
  ready.member(member_);
  ready.revision(revision);
  for (const Writing& writing : writings_) ready.writes().push_back(writing.topic.name);
  if (revision > 0) {
    for (const Reading& reading : readings_) ready.reads().push_back(reading.topic.name);
  }
  ready_->write(ready);
}

void LockstepClient::on_step(msg::Step& step, ParticipantId source) {
  const bool joining = phase_ == Phase::matching || phase_ == Phase::declared;
  if ((!joining && phase_ != Phase::member) || source != server_) return;
  if (step_ && step.k() == step_->k() && !handed_out_) {  // amended or repeated, but answered already
    answer_again_();
    return;
  }
  for (const auto& order : step.orders()) {
    if (order.source() != participant_.id()) continue;
    order_ = order.order() == kOrderStop ? Order::stop : Order::kill;
    phase_ = Phase::ordered;
    return;
  }
  const auto& members = step.members();
  const bool ours = std::any_of(members.begin(), members.end(),
                                [&](const auto& m) { return m.source() == participant_.id() && m.name() == member_; });
  if (!ours) {
    // The server pauses from the invitation until this program has joined, or until it gives the program up.
    const bool given_up = joining && (!invited_after_ || step.k() > *invited_after_);
    if (given_up) spdlog::error("{}: sim_server gave this program up while it joined; start it again", member_);
    if (given_up || phase_ == Phase::member) phase_ = Phase::dropped;
    return;
  }
  phase_ = Phase::member;
  ParticipantId router = 0;
  for (const auto& m : members) {
    if (m.name() == kRouterName) router = m.source();
  }
  if (router != router_) change_router(router);
  if (handed_out_) return;  // amended because the router died: there is nothing more to wait for
  std::vector<CountedQueues::Expected> expected;
  for (const auto& e : step.expected()) {
    expected.push_back({e.topic(), e.source(), e.count()});
    if (e.source() == router_) delivered_[e.topic()] = e.count();
  }
  queues_.expect(expected);
  pending_ = std::move(step);
}

bool LockstepClient::matched(Counterpart counterpart, ParticipantId who) const {
  return std::all_of(
             readings_.begin(), readings_.end(),
             [&](const Reading& r) { return r.counterpart != counterpart || contains(r.reader->matched(), who); }) &&
         std::all_of(writings_.begin(), writings_.end(), [&](const Writing& w) {
           return w.counterpart != counterpart || !w.open || w.writer->matches(who);
         });
}

bool LockstepClient::router_matched() {
  if (router_ == 0 || router_ == matched_router_) return true;  // avoids asking the vendor in each step
  // Only the own writer knows whether Done reaches the router: Attached only says that the router found the writer.
  const bool heard = router_ == participant_.id() || done_->matches(router_);
  if (heard && matched(Counterpart::router, router_)) matched_router_ = router_;
  return router_ == matched_router_;
}

LockstepClient::Event LockstepClient::poll() {
  if (phase_ == Phase::dropped) return Event::dropped;
  if (phase_ == Phase::ordered) {
    phase_ = Phase::stopped;
    if (before_obeying_) before_obeying_();
    obey_(order_);  // may throw to the caller that gives turns: then the fault is over at the next turn
  }
  if (phase_ == Phase::stopped) {
    phase_ = Phase::dropped;  // the fleet has continued, and the missed samples are lost
    return Event::resumed;
  }
  if (phase_ == Phase::matching && matched(Counterpart::server, server_) && done_->matches(server_) &&
      contains(step_reader_->matched(), server_) && (!declare_condition_ || declare_condition_())) {
    say_ready(1);
    phase_ = Phase::declared;
  }
  if (!pending_ && !handed_out_) return Event::none;
  // A router that has (re)joined delivers nothing before this step is answered, so there is time for its match.
  if (!router_matched()) return Event::none;
  if (!handed_out_) {
    if (!queues_.complete() || (think_condition_ && !think_condition_(*pending_))) return Event::none;
    step_ = std::move(pending_);
    pending_.reset();
    for (Writing& writing : writings_) writing.writer->begin_step();
    handed_out_ = true;
    queues_.release();
    if (!router_matched()) return Event::none;  // a handler has opened something
  }
  handed_out_ = false;
  return Event::think;
}

bool LockstepClient::write(const std::string& topic, std::span<const std::uint8_t> payload) {
  const auto it =
      std::find_if(writings_.begin(), writings_.end(), [&](const Writing& w) { return w.topic.name == topic; });
  if (it == writings_.end()) throw std::logic_error("topic was not declared: " + topic);
  // While the router is away there is no radio: the message is lost as it would be in the air.
  if (it->counterpart == Counterpart::router && router_ == 0) return false;
  return it->writer->write(payload);
}

void LockstepClient::done(const std::vector<std::uint8_t>& digest) {
  auto done = message_of<msg::Done>(inbox_.run());
  done.k(step_->k());
  done.epoch(step_->epoch());
  done.member(member_);
  for (const Writing& writing : writings_) {
    done.sent().push_back(topic_count(writing.topic.name, participant_.id(), writing.writer->count()));
  }
  done.digest(digest);
  done_->begin_step();
  done_->write(done);
  last_done_ = std::move(done);
}

bool LockstepClient::server_present() const {
  const std::vector<ParticipantId> writers = step_reader_->matched();
  return server_ == 0 ? !writers.empty() : contains(writers, server_);
}

bool LockstepClient::waits_for_matches() const {
  return phase_ == Phase::matching || ((pending_ || handed_out_) && router_ != 0 && router_ != matched_router_);
}

std::string LockstepClient::waiting_for() const {
  switch (phase_) {
    case Phase::created:
      return "start";
    case Phase::hello:
      return "an invitation from sim_server";
    case Phase::matching:
      return "topics to match with sim_server";
    case Phase::declared:
      return "the first step";
    case Phase::ordered:
    case Phase::stopped:
    case Phase::dropped:
      return "nothing: dropped by sim_server";
    case Phase::member:
      break;
  }
  if (handed_out_) return "radio topics to match with comm_router";
  if (!pending_) return "the next step";
  std::string text = "samples announced by sim_server:";
  for (const auto& m : queues_.missing()) text += " " + m + ";";
  return text;
}

}  // namespace skein::bus
