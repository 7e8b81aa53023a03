#include "comm_router/radio_registry.hpp"

#include <algorithm>
#include <utility>

namespace skein::router {
namespace {

constexpr const char* kNoWriter =
    "name: the asking member has no matching writer of this topic: create it before you ask, RELIABLE and of this type "
    "(a BEST_EFFORT writer may lose messages, which lock-step does not allow)";

constexpr const char* kNoReader =
    "name: the asking member has no matching reader of what arrives on this topic: create it when the reply says that "
    "the topic is open, of this type and VOLATILE";

constexpr const char* kNoMore =
    "name: this member has asked three times for topics for which it has no matching writer or reader; the router "
    "refuses all its further requests";

}  // namespace

RadioRegistry::RadioRegistry(const Scenario& scenario, RadioTable& table, RadioEndpoints endpoints)
    : scenario_(scenario), table_(table), endpoints_(std::move(endpoints)), declared_(table.routes().size()) {}

void RadioRegistry::begin_step(const std::vector<RadioRequest>& requests) {
  forget_the_lost();
  decided_by_clock_.clear();
  std::vector<RadioRequest> due = std::exchange(put_off_, {});
  due.insert(due.end(), requests.begin(), requests.end());
  for (const RadioRequest& request : due) {
    if (awaits_type(request)) {
      put_off_.push_back(request);
      continue;
    }
    try {
      if (histories_[request.asker.source].in_vain >= kMaxVain) throw InputError(kNoMore);
      request.listen ? listen(request) : send(request);
    } catch (const InputError& error) {
      refuse(request.asker, error.what());
    }
  }
}

void RadioRegistry::forget_the_lost() {
  const auto lost = [&](const auto& entry) { return endpoints_.lost(entry.asker.source); };
  std::erase_if(sendings_, lost);
  std::erase_if(listenings_, lost);
  std::erase_if(put_off_, lost);
  std::erase_if(histories_, [&](const auto& entry) { return endpoints_.lost(entry.first); });
}

/// Whether the request names another type than an earlier request of this step that may still be refused, because its
/// asker's writer has not matched. Such a request is decided in the next step, so that no member loses a topic because
/// of another member's mistake.
bool RadioRegistry::awaits_type(const RadioRequest& request) const {
  bool contradicts = false;
  for (std::size_t route = 0; route < table_.routes().size(); ++route) {
    const RadioRoute& known = table_.routes()[route];
    if (known.ros_topic != request.name || known.targets.empty()) continue;
    if (route < declared_ || used_.contains(route)) return false;  // the type is settled
    contradicts = contradicts || known.ros_type != request.type;
  }
  return contradicts;
}

/// @throws InputError for another type than that in the earlier request of a listener for this topic.
void RadioRegistry::check_type(const RadioRequest& request) const {
  for (const Listening& other : listenings_) {
    const bool replaced = request.listen && other.asker.source == request.asker.source;
    if (replaced || other.ros_topic != request.name || other.ros_type == request.type) continue;
    throw InputError("type: '" + scenario_.node_name(other.asker.node) + "' asked for '" + request.name + "' as " +
                     other.ros_type + " before; a topic has one type");
  }
}

void RadioRegistry::send(const RadioRequest& request) {
  const std::string& own = scenario_.node_name(request.asker.node);
  if (request.source != own) {
    throw InputError("source: '" + request.source + "' is not the asking node, which is '" + own + "'");
  }
  const auto by_asker = [&](const Sending& s) { return s.asker.source == request.asker.source; };
  std::set<std::size_t>& asked = histories_[request.asker.source].routes;
  const auto known = [&](std::size_t route) { return table_.routes()[route].ros_topic == request.name; };
  if (asked.size() >= kMaxTopics && std::ranges::none_of(asked, known)) {
    throw InputError("name: a member may ask to send on " + std::to_string(kMaxTopics) + " registered topics at most");
  }
  check_type(request);
  const std::size_t route = table_.open(request.asker.node, request.name, request.type, request.targets);
  asked.insert(route);
  endpoints_.open(route);
  // A member may ask again; only its last request is answered.
  std::erase_if(sendings_, [&](const Sending& s) { return by_asker(s) && s.route == route; });
  sendings_.push_back({.asker = request.asker, .route = route});
}

void RadioRegistry::listen(const RadioRequest& request) {
  const RadioTarget arrival = table_.arrival(request.asker.node, request.name, request.type);
  check_type(request);
  const auto by_asker = [&](const Listening& l) { return l.asker.source == request.asker.source; };
  std::erase_if(listenings_, [&](const Listening& l) { return by_asker(l) && l.arrival.topic == arrival.topic; });
  if (std::ranges::count_if(listenings_, by_asker) >= static_cast<std::ptrdiff_t>(kMaxTopics)) {
    throw InputError("name: a member may listen to " + std::to_string(kMaxTopics) + " registered topics at most");
  }
  listenings_.push_back(
      {.asker = request.asker, .ros_topic = request.name, .ros_type = request.type, .arrival = arrival});
}

void RadioRegistry::refuse(const Asker& asker, const std::string& reason) {
  replies_.push_back({.asker = asker, .reason = reason});
}

bool RadioRegistry::is_matched(const Sending& sending) const {
  return sending.state != State::asked || endpoints_.hears(sending.route, sending.asker.source);
}

bool RadioRegistry::is_matched(const Listening& listening) const {
  return listening.state != State::open || listening.matched ||
         endpoints_.reaches(listening.arrival, listening.asker.source);
}

std::vector<AwaitedRequest> RadioRegistry::awaited() const {
  std::vector<AwaitedRequest> awaited;
  const auto waits = [&](const auto& entry) { return !is_matched(entry) && !endpoints_.lost(entry.asker.source); };
  for (const Sending& sending : sendings_) {
    if (waits(sending)) awaited.push_back({sending.asker, table_.routes()[sending.route].topic + " to match"});
  }
  for (const Listening& listening : listenings_) {
    if (waits(listening)) awaited.push_back({listening.asker, listening.arrival.topic + " to match"});
  }
  return awaited;
}

void RadioRegistry::refuse_unmatched(const Asker& asker, const std::string& topic, const char* reason) {
  ++histories_[asker.source].in_vain;
  decided_by_clock_.push_back(scenario_.node_name(asker.node) + " was refused the radio topic " + topic +
                              ": no writer or reader of its own matched in time");
  refuse(asker, reason);
}

bool RadioRegistry::heard(const RadioTarget& target) const {
  return endpoints_.declared(target) || std::ranges::any_of(listenings_, [&](const Listening& listening) {
           return listening.matched && listening.arrival.node == target.node && listening.arrival.topic == target.topic;
         });
}

std::vector<RadioReply> RadioRegistry::end_step() {
  forget_the_lost();
  for (Listening& listening : listenings_) {
    if (listening.state != State::open) continue;
    listening.matched = is_matched(listening);
    if (listening.matched) continue;
    listening.state = State::refused;
    refuse_unmatched(listening.asker, listening.ros_topic, kNoReader);
  }
  settle_sendings();
  settle_listenings();
  return std::exchange(replies_, {});
}

void RadioRegistry::settle_sendings() {
  for (Sending& sending : sendings_) {
    RadioReply reply{.asker = sending.asker, .open = true};
    if (!is_matched(sending)) {
      sending.state = State::refused;
      refuse_unmatched(sending.asker, table_.routes()[sending.route].ros_topic, kNoWriter);
      continue;
    }
    if (sending.state == State::asked) endpoints_.admit(sending.route, sending.asker.source);
    sending.state = State::open;
    if (sending.route >= declared_) used_.insert(sending.route);
    for (const RadioTarget& target : table_.routes()[sending.route].targets) {
      if (!heard(target)) reply.unheard.push_back(scenario_.node_name(target.node));
    }
    tell(reply, sending.told);
  }
  std::erase_if(sendings_, [](const Sending& sending) { return sending.state == State::refused; });
  close_unused_routes();
}

/// Closes the routes whose askers were all refused or lost, so that they decide neither a topic's type nor who may use
/// a name. A route on which a member could send stays: messages may be under way on it, and their counts go on.
void RadioRegistry::close_unused_routes() {
  for (std::size_t route = declared_; route < table_.routes().size(); ++route) {
    if (used_.contains(route) || table_.routes()[route].targets.empty()) continue;
    if (std::ranges::find(sendings_, route, &Sending::route) != sendings_.end()) continue;
    endpoints_.close(route);
    table_.close(route);
  }
}

// The type of a route is that of its listeners: begin_step() refuses every other.
void RadioRegistry::settle_listenings() {
  for (Listening& listening : listenings_) {
    if (listening.state != State::asked) continue;  // open, or refused already
    const auto arrives = [&](const RadioRoute& route) {
      return route.ros_topic == listening.ros_topic &&
             std::ranges::find(route.targets, listening.asker.node, &RadioTarget::node) != route.targets.end();
    };
    const RadioReply reply{.asker = listening.asker, .open = std::ranges::any_of(table_.routes(), arrives)};
    if (reply.open) listening.state = State::open;
    tell(reply, listening.told);
  }
  std::erase_if(listenings_, [](const Listening& listening) { return listening.state == State::refused; });
}

void RadioRegistry::tell(const RadioReply& reply, std::optional<RadioReply>& told) {
  if (told == reply) return;
  told = reply;
  replies_.push_back(reply);
}

}  // namespace skein::router
