#include "bus/lockstep/client.hpp"

#include <algorithm>

#include "bus/lockstep/names.hpp"

namespace skein::bus {

LockstepClient::LockstepClient(Participant& participant, Inbox& inbox, std::string member)
    : participant_(participant), inbox_(inbox), member_(std::move(member)) {}

void LockstepClient::read(const TopicSpec& topic, Counterpart counterpart, CountedQueues::Handler handler) {
  queues_.add_topic(topic.name, std::move(handler));
  readings_.push_back({topic, counterpart, nullptr});
}

void LockstepClient::declare_writer(const TopicSpec& topic, Counterpart counterpart) {
  writings_.push_back({topic, counterpart, nullptr});
}

void LockstepClient::start() {
  resync_reader_ = subscribe<msg::Resync>(
      inbox_, participant_, spec(topics::resync()),
      [this](const msg::Resync& resync, ParticipantId source) { on_resync(resync, source); });
  step_reader_ = subscribe<msg::Step>(inbox_, participant_, spec(topics::step()),
                                      [this](msg::Step& step, ParticipantId source) { on_step(step, source); });
  done_ = std::make_unique<CountedWriter>(participant_, spec(topics::done()));
  ready_ = std::make_unique<CountedWriter>(participant_, spec(topics::ready()));
  phase_ = Phase::hello;
  say_ready(0);
}

void LockstepClient::on_resync(const msg::Resync& resync, ParticipantId source) {
  if (phase_ != Phase::hello || resync.source() != participant_.id()) return;
  server_ = source;
  for (const auto& base : resync.base()) base_.push_back({base.topic(), base.source(), base.count()});
  create_endpoints();
  phase_ = Phase::matching;
}

// Data endpoints are made only now: the server stands still until we are a member, so nothing is in flight on them
// and the bases it told us are exact.
void LockstepClient::create_endpoints() {
  for (Reading& reading : readings_) {
    const auto queue = [this, name = reading.topic.name, counterpart = reading.counterpart](Sample&& s) {
      // The router delivers only after we answered a step that names it, so it is known by now.
      if (s.source == (counterpart == Counterpart::server ? server_ : router_)) queues_.arrive(name, std::move(s));
    };
    // Of no use before the step that counts them; once that is here, rings() waits for any sample.
    reading.reader = inbox_.subscribe(participant_, reading.topic, queue, Bell::silent);
  }
  for (Writing& writing : writings_) writing.writer = std::make_unique<CountedWriter>(participant_, writing.topic);
  for (const auto& base : base_) {
    // What is latched is received again, so it counts again.
    const bool latched = std::any_of(readings_.begin(), readings_.end(), [&](const Reading& r) {
      return r.topic.name == base.topic && r.topic.qos.latched;
    });
    if (!latched) queues_.set_base(base.topic, base.source, base.count);
  }
}

void LockstepClient::say_ready(std::uint32_t revision) {
  msg::Ready ready;
  ready.member(member_);
  ready.revision(revision);
  if (revision > 0) {
    for (const Reading& reading : readings_) ready.reads().push_back(reading.topic.name);
    for (const Writing& writing : writings_) ready.writes().push_back(writing.topic.name);
  }
  ready_->write(ready);
}

void LockstepClient::on_step(msg::Step& step, ParticipantId source) {
  if ((phase_ != Phase::declared && phase_ != Phase::member) || source != server_) return;
  if (step_ && step.k() == step_->k()) return;  // amended, but we have answered it already
  const auto& members = step.members();
  const bool ours = std::any_of(members.begin(), members.end(),
                                [&](const auto& m) { return m.source() == participant_.id() && m.name() == member_; });
  if (!ours) {
    if (phase_ == Phase::member) phase_ = Phase::dropped;
    return;
  }
  phase_ = Phase::member;
  ParticipantId router = 0;
  for (const auto& m : members) {
    if (m.name() == kRouterName) router = m.source();
  }
  if (router != router_) queues_.discard(router_);
  router_ = router;
  std::vector<CountedQueues::Expected> expected;
  for (const auto& e : step.expected()) expected.push_back({e.topic(), e.source(), e.count()});
  queues_.expect(expected);
  pending_ = std::move(step);
}

bool LockstepClient::matched(Counterpart counterpart, ParticipantId who) const {
  return std::all_of(
             readings_.begin(), readings_.end(),
             [&](const Reading& r) { return r.counterpart != counterpart || contains(r.reader->matched(), who); }) &&
         std::all_of(writings_.begin(), writings_.end(),
                     [&](const Writing& w) { return w.counterpart != counterpart || w.writer->matches(who); });
}

bool LockstepClient::router_matched() {
  if (router_ != matched_router_ && matched(Counterpart::router, router_)) matched_router_ = router_;
  return router_ == 0 || router_ == matched_router_;
}

LockstepClient::Event LockstepClient::poll() {
  if (phase_ == Phase::dropped) return Event::dropped;
  if (phase_ == Phase::matching && matched(Counterpart::server, server_) && done_->matches(server_) &&
      contains(step_reader_->matched(), server_) && (!declare_condition_ || declare_condition_())) {
    say_ready(1);
    phase_ = Phase::declared;
  }
  if (!pending_) return Event::none;
  // A router that (re)joined delivers nothing before this step's answer, so its match can be awaited here.
  if (!router_matched()) return Event::none;
  if (!queues_.complete() || (think_condition_ && !think_condition_(*pending_))) return Event::none;
  step_ = std::move(pending_);
  pending_.reset();
  for (Writing& writing : writings_) writing.writer->begin_step();
  queues_.release();
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
  msg::Done done;
  done.k(step_->k());
  done.epoch(step_->epoch());
  done.member(member_);
  for (const Writing& writing : writings_) {
    msg::TopicCount count;
    count.topic(writing.topic.name);
    count.source(participant_.id());
    count.count(writing.writer->count());
    done.sent().push_back(count);
  }
  done.digest(digest);
  done_->begin_step();
  done_->write(done);
}

bool LockstepClient::server_present() const { return server_ != 0 && contains(step_reader_->matched(), server_); }

bool LockstepClient::waits_for_matches() const {
  return phase_ == Phase::matching || (pending_ && router_ != 0 && router_ != matched_router_);
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
    case Phase::dropped:
      return "nothing: dropped by sim_server";
    case Phase::member:
      break;
  }
  if (!pending_) return "the next step";
  std::string text = "samples announced by sim_server:";
  for (const auto& m : queues_.missing()) text += " " + m + ";";
  return text;
}

}  // namespace skein::bus
