#include "comm_router/router_sync.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace skein::router {
namespace {

/// Limits the memory for a participant that is not a member and still sends (a tool in a UAV's domain). No participant
/// sends nearly as many samples before it becomes a member.
constexpr std::size_t kMaxStrangerSamples = 4096;

/// Limits the memory for a sender that never announces its messages. No step has nearly as many messages on one topic.
constexpr std::size_t kMaxWaiting = 16 * topics::kRadioDepth;

/// A member answers only the steps that it is asked to answer. A participant with more waiting answers is not a member.
constexpr std::size_t kMaxAnswers = 64;

const std::string kAdvice =
    fmt::format("a program may send {} on a topic in one step (docs/lockstep.md)", topics::kRadioDepth);
const std::string kRequests = topics::radio_request().name;

std::optional<std::uint64_t> count_of(const std::vector<SentCount>& sent, const std::string& topic) {
  const auto found = std::ranges::find(sent, topic, &SentCount::topic);
  return found == sent.end() ? std::nullopt : std::optional(found->count);
}

}  // namespace

void RouterSync::on_step(std::uint64_t k, std::uint32_t epoch, std::vector<RadioMember> members, Links links) {
  if (last_k_ && k <= *last_k_) return;
  for (const RadioMember& member : members) {
    if (!gone_.contains(member.source)) senders_[member.source].member = member.name;
  }
  steps_[k] = {epoch, std::move(members), std::move(links)};
}

void RouterSync::on_done(SourceId source, std::uint64_t k, std::vector<SentCount> sent) {
  if (gone_.contains(source) || (last_k_ && k <= *last_k_)) return;
  Sender& sender = senders_[source];
  sender.done[k] = std::move(sent);
  if (sender.done.size() > kMaxAnswers) {
    forget(source, fmt::format("answered more than {} steps that it was not asked to answer: answer each step once",
                               kMaxAnswers));
  }
}

void RouterSync::on_radio(SourceId source, std::size_t route, Payload payload) {
  // Discards messages on a registered topic from participants that open() has not admitted to it.
  const auto sender = senders_.find(source);
  if (route >= declared_ && (sender == senders_.end() || !sender->second.opened.contains(route))) return;
  const std::string& bound = routes_[route].member;
  if (!bound.empty() && sender != senders_.end() && !sender->second.member.empty() && sender->second.member != bound) {
    return;
  }
  queue(source, routes_[route].topic, std::move(payload));
}

void RouterSync::on_request(SourceId source, Payload payload) { queue(source, kRequests, std::move(payload)); }

void RouterSync::queue(SourceId source, const std::string& topic, Payload payload) {
  if (gone_.contains(source)) return;
  Sender& sender = senders_[source];
  if (sender.member.empty() && ++sender.waiting_as_stranger > kMaxStrangerSamples) {
    forget(source,
           fmt::format("sent more than {} messages before its first step: send only in steps", kMaxStrangerSamples));
    return;
  }
  Lane& lane = sender.lanes[topic];
  if (lane.waiting.size() < kMaxWaiting) {
    lane.waiting.push_back(std::move(payload));
  } else if (!std::exchange(lane.overflowed, true)) {
    excesses_.push_back(
        {source, fmt::format("sent more than {} messages on {} in one step, or without announcing them, "
                             "and the router discards the further ones; {}",
                             kMaxWaiting, topic, kAdvice)});
  }
}

void RouterSync::open(SourceId source, std::size_t route) {
  const auto found = senders_.find(source);
  if (found == senders_.end() || route < declared_ || !found->second.opened.insert(route).second) return;
  Sender& sender = found->second;
  const std::string& topic = routes_[route].topic;
  sender.lanes[topic] = {.taken = count_of(sender.last_done, topic).value_or(0), .waiting = {}};
}

void RouterSync::on_drop(std::uint64_t k, SourceId source) { dropped_from_.emplace(source, k); }

void RouterSync::set_base(SourceId source, const std::string& topic, std::uint64_t count) {
  if (!gone_.contains(source)) senders_[source].lanes[topic].taken = count;
}

std::optional<StepBatch> RouterSync::take() {
  if (steps_.empty()) return std::nullopt;
  const std::uint64_t k = steps_.begin()->first;
  forget_the_gone(k);
  Step& step = steps_.begin()->second;
  const auto ready = [&](const RadioMember& member) { return complete(k, member); };
  if (!std::ranges::all_of(step.members, ready)) return std::nullopt;

  StepBatch batch{k, step.epoch, std::move(step.links), {}, {}};
  for (const RadioMember& member : step.members) take_messages(k, member, batch);
  steps_.erase(steps_.begin());
  last_k_ = k;
  return batch;
}

std::size_t RouterSync::missing_answers() const {
  if (steps_.empty()) return 0;
  const auto& [k, step] = *steps_.begin();
  return static_cast<std::size_t>(std::ranges::count_if(step.members, [&, k = k](const RadioMember& member) {
    const auto sender = senders_.find(member.source);
    return !gone_.contains(member.source) && (sender == senders_.end() || !sender->second.done.contains(k));
  }));
}

std::vector<AwaitedMember> RouterSync::awaited() const {
  std::vector<AwaitedMember> missing;
  if (steps_.empty()) return missing;
  const auto& [k, step] = *steps_.begin();
  for (const RadioMember& member : step.members) {
    if (complete(k, member)) continue;
    const auto sender = senders_.find(member.source);
    if (sender == senders_.end() || !sender->second.done.contains(k)) {
      missing.push_back({member, "done"});
      continue;
    }
    for (const SentCount& sent : radio_counts(sender->second, k, member)) {
      const std::uint64_t arrived = sender->second.arrived(sent.topic);
      if (arrived >= sent.count) continue;
      std::string what = sent.topic + " " + std::to_string(arrived) + " of " + std::to_string(sent.count);
      if (sender->second.overflowed(sent.topic))
        what += fmt::format(", since the router keeps {}: {}", kMaxWaiting, kAdvice);
      missing.push_back({member, std::move(what)});
    }
  }
  return missing;
}

std::optional<std::uint64_t> RouterSync::next_step() const {
  return steps_.empty() ? std::nullopt : std::optional(steps_.begin()->first);
}

std::uint64_t RouterSync::Sender::arrived(const std::string& topic) const {
  const auto lane = lanes.find(topic);
  return lane == lanes.end() ? 0 : lane->second.taken + lane->second.waiting.size();
}

bool RouterSync::Sender::overflowed(const std::string& topic) const {
  const auto lane = lanes.find(topic);
  return lane != lanes.end() && lane->second.overflowed;
}

std::vector<SentCount> RouterSync::radio_counts(const Sender& sender, std::uint64_t k,
                                                const RadioMember& member) const {
  std::vector<SentCount> counts;
  const std::vector<SentCount>& sent = sender.done.at(k);
  if (const auto count = count_of(sent, kRequests)) counts.push_back({kRequests, *count});
  for (std::size_t route = 0; route < routes_.size(); ++route) {
    if (!this->counts(sender, route, member)) continue;
    if (const auto count = count_of(sent, routes_[route].topic)) counts.push_back({routes_[route].topic, *count});
  }
  return counts;
}

bool RouterSync::counts(const Sender& sender, std::size_t route, const RadioMember& member) const {
  const RadioRoute& r = routes_[route];
  return r.source == member.node && (r.member.empty() || r.member == member.name) &&
         (route < declared_ || sender.opened.contains(route));
}

bool RouterSync::complete(std::uint64_t k, const RadioMember& member) const {
  if (gone_.contains(member.source)) return true;  // not waited for, and adds nothing
  const auto found = senders_.find(member.source);
  if (found == senders_.end() || !found->second.done.contains(k)) return false;
  const std::vector<SentCount> counts = radio_counts(found->second, k, member);
  return std::ranges::all_of(counts,
                             [&](const SentCount& sent) { return found->second.arrived(sent.topic) >= sent.count; });
}

void RouterSync::take_messages(std::uint64_t k, const RadioMember& member, StepBatch& batch) {
  const auto found = senders_.find(member.source);
  if (found == senders_.end()) return;
  Sender& sender = found->second;
  sender.last_done = std::move(sender.done.at(k));
  sender.done.erase(sender.done.begin(), sender.done.upper_bound(k));
  // Samples beyond the count stay in the lane: they belong to the next step.
  const auto take = [&](const std::string& topic, auto&& use) {
    const auto count = count_of(sender.last_done, topic);
    if (!count) return;
    Lane& lane = sender.lanes[topic];
    while (lane.taken < *count) {
      use(lane.taken++, std::move(lane.waiting.front()));
      lane.waiting.pop_front();
    }
  };
  take(kRequests, [&](std::uint64_t, Payload&& payload) {
    batch.requests.push_back({member.source, member.node, std::move(payload)});
  });
  for (std::size_t route = 0; route < routes_.size(); ++route) {
    if (!counts(sender, route, member)) continue;
    take(routes_[route].topic, [&](std::uint64_t sequence, Payload&& payload) {
      batch.messages.push_back({route, sequence, std::move(payload)});
    });
  }
}

void RouterSync::forget_the_gone(std::uint64_t k) {
  for (const auto& [source, from_k] : dropped_from_) {
    if (from_k <= k) forget(source);
  }
  const std::vector<RadioMember>& members = steps_.at(k).members;
  const auto leaves = [&](const SourceId source) {
    return std::ranges::find(members, source, &RadioMember::source) == members.end();
  };
  for (const SourceId source : members_before_) {
    if (leaves(source)) forget(source);
  }
  members_before_.clear();
  for (const RadioMember& member : members) members_before_.push_back(member.source);
}

void RouterSync::forget(SourceId source) {
  senders_.erase(source);
  gone_.insert(source);
}

void RouterSync::forget(SourceId source, const std::string& excess) {
  excesses_.push_back({source, excess + "; the router discards all that it sends"});
  forget(source);
}

}  // namespace skein::router
