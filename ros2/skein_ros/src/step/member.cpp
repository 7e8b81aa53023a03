#include "member.hpp"

#include <unistd.h>
#include <algorithm>

#include <csignal>
#include <cstdlib>

#include <skein_msgs/msg/ready.hpp>
#include <skein_msgs/msg/resync.hpp>

#include "endpoints.hpp"
#include "fleet_topics.hpp"
#include "leaving.hpp"

namespace skein_ros {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using std::chrono::steady_clock;

constexpr milliseconds kMatchPoll{2};
constexpr milliseconds kIdlePoll{500};
constexpr seconds kLinger{5};  // the last answer may take this long to arrive
constexpr seconds kNotice{10};

std::int64_t ns(const builtin_interfaces::msg::Time& time) { return time.sec * 1'000'000'000LL + time.nanosec; }

}  // namespace

void Member::say_ready(std::uint32_t revision) {
  skein_msgs::msg::Ready ready;
  ready.run = setup_.run;
  ready.member = setup_.uav;
  ready.revision = revision;
  if (revision == 0) {
    // Which of these the node really writes is known once it has created its publishers.
    ready.writes.push_back("rt/" + setup_.uav + "/activity");
    for (const auto& name : setup_.debug_values) ready.writes.push_back("rt/" + setup_.uav + "/debug/" + name);
  } else {
    const auto add_name = [](auto& names, const auto& end) {
      const std::string name = "rt" + end.topic();
      if (end.counterpart() == Counterpart::none) return;
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    };
    for (const auto& incoming : incomings_) add_name(ready.reads, *incoming);
    for (const auto& outgoing : outgoings_) add_name(ready.writes, *outgoing);
  }
  publish(ready_, ready);
}

void Member::open(rmw_context_t* context) {
  const auto drawn = steady_clock::now().time_since_epoch().count();
  const std::string name = "_skein_step_" + std::to_string(::getpid()) + "_" + std::to_string(drawn);
  context_ = context;
  node_ = SKEIN_REAL(rmw_create_node)(context, name.c_str(), "/");
  if (node_ == nullptr) fail(std::string("no node for the lock-step: ") + rmw_get_error_string().str);
  wait_set_ = rmw_create_wait_set(context, 0);
  resyncs_ = subscribe<skein_msgs::msg::Resync>(node_, "/skein/resync", 16, true);
  steps_ = subscribe<skein_msgs::msg::Step>(node_, "/skein/step", kStateDepth, false);
  done_ = advertise<skein_msgs::msg::Done>(node_, "/skein/done", kStateDepth, false);
  ready_ = advertise<skein_msgs::msg::Ready>(node_, "/skein/ready", 4, true);
  say_ready(0);
  wait_for_invitation();
  open_ = true;
}

void Member::close(const rmw_context_t* context) {
  if (node_ == nullptr || context != context_) return;
  const auto check = [](rmw_ret_t result) {
    if (result != RMW_RET_OK) rmw_reset_error();
  };
  for (rmw_subscription_t* const mine : {resyncs_, steps_}) check(SKEIN_REAL(rmw_destroy_subscription)(node_, mine));
  for (rmw_publisher_t* const mine : {done_, ready_}) check(SKEIN_REAL(rmw_destroy_publisher)(node_, mine));
  for (const Incoming* const mine : {captures_, acks_, neighbours_}) {
    if (mine == nullptr) continue;
    check(SKEIN_REAL(rmw_destroy_subscription)(node_, mine->subscription()));
    remove(*mine);
  }
  for (const Outgoing* const mine : {reports_, stored_}) {
    if (mine == nullptr) continue;
    check(SKEIN_REAL(rmw_destroy_publisher)(node_, mine->publisher()));
    remove(*mine);
  }
  check(rmw_destroy_wait_set(wait_set_));
  check(rmw_destroy_node(node_));
  node_ = nullptr;
  over_ = true;
}

void Member::wait_for_invitation() {
  waiting_since_ = said_at_ = steady_clock::now();
  while (self_ == 0 || !take_invitation()) {
    if (interrupted_) exit_at_once(0);
    if (self_ == 0) self_ = own_source(node_, done_->topic_name);
    void* list[] = {resyncs_->data};
    rmw_subscriptions_t subscriptions{1, list};
    const rmw_time_t timeout{0, self_ == 0 ? 2'000'000U : 500'000'000U};
    if (SKEIN_REAL(rmw_wait)(&subscriptions, nullptr, nullptr, nullptr, nullptr, wait_set_, &timeout) != RMW_RET_OK) {
      rmw_reset_error();
    }
    report_waiting();
  }
}

bool Member::take_invitation() {
  skein_msgs::msg::Resync resync;
  rmw_message_info_t info;
  while (take(resyncs_, resync, info)) {
    if (resync.run != setup_.run || resync.source != self_) continue;
    server_ = writers_.of(resyncs_, info);
    base_.clear();  // an earlier invitation may have come before its writer was known
    for (const auto& count : resync.base) base_.push_back({count.topic, {count.source, count.count}});
    invited_after_ = resync.epoch > 0 ? std::optional(resync.k) : std::nullopt;
    now_ns_ = static_cast<std::int64_t>(resync.k) * setup_.exchange_ns;
    return server_ != 0;
  }
  return false;
}

/// Creates the endpoints for the custody of captures. The ground station has no camera, and needs none.
void Member::open_custody() {
  const std::string captures = "/captures/" + setup_.uav, acks = "/captures_ack/" + setup_.uav + "/" + setup_.uav;
  const auto in = [&](auto message, const std::string& topic, Counterpart counterpart, int depth) {
    using Message = decltype(message);
    return &add(std::make_unique<Incoming>(subscribe<Message>(node_, topic, depth, false), type_of<Message>(),
                                           counterpart, depth, false));
  };
  const auto out = [&](auto message, const std::string& topic, Counterpart counterpart, int depth) {
    using Message = decltype(message);
    return &add(std::make_unique<Outgoing>(advertise<Message>(node_, topic, depth, false), type_of<Message>(),
                                           counterpart, depth));
  };
  captures_ = in(skein_msgs::msg::CaptureReports(), "/skein/capture", Counterpart::server, kCommandDepth);
  acks_ = in(skein_msgs::msg::CaptureAck(), acks, Counterpart::router, kRadioDepth);
  neighbours_ =
      in(sensor_msgs::msg::PointCloud2(), "/" + setup_.uav + "/nbr_odom_cloud", Counterpart::server, kStateDepth);
  reports_ = out(skein_msgs::msg::CaptureReports(), captures, Counterpart::router, kRadioDepth);
  stored_ = out(skein_msgs::msg::CaptureAck(), "/skein/capture_ack", Counterpart::server, kCommandDepth);
}

bool Member::all_matched() const {
  const auto in = [&](const auto& end) {
    return end->counterpart() != Counterpart::server || has_matched(node_, end->subscription(), server_);
  };
  const auto out = [&](const auto& end) {
    return end->counterpart() != Counterpart::server || has_matched(node_, end->publisher(), server_);
  };
  return has_matched(node_, steps_, server_) && has_matched(node_, done_, server_) &&
         std::all_of(incomings_.begin(), incomings_.end(), in) &&
         std::all_of(outgoings_.begin(), outgoings_.end(), out);
}

void Member::declare() {
  if (setup_.uav != "gcs") open_custody();
  waiting_since_ = said_at_ = steady_clock::now();
  while (!all_matched()) {
    rmw_reset_error();
    if (interrupted_) exit_at_once(0);
    sleep_really(kMatchPoll);
    report_waiting();
    if (steady_clock::now() - waiting_since_ > kLinger) look_for_server();
  }
  declared_ = true;
  say_ready(1);
}

/// True if the router that the present step names has matched this node's endpoints, or if the step names no router.
bool Member::router_matched() {
  if (router_ == 0 || router_ == matched_router_) return true;
  const auto in = [&](const auto& end) {
    return end->counterpart() != Counterpart::router || has_matched(node_, end->subscription(), router_);
  };
  const auto out = [&](const auto& end) {
    return end->counterpart() != Counterpart::router || has_matched(node_, end->publisher(), router_);
  };
  const bool matched = has_matched(node_, done_, router_) && std::all_of(incomings_.begin(), incomings_.end(), in) &&
                       std::all_of(outgoings_.begin(), outgoings_.end(), out);
  if (matched) matched_router_ = router_;
  return matched;
}

void Member::wait_a_little(rmw_guard_conditions_t* guards, bool* interrupted) {
  std::vector<void*> subscribers = {steps_->data}, conditions;
  if (pending_) {
    for (const auto& incoming : incomings_) {
      if (!incoming->complete()) subscribers.push_back(incoming->subscription()->data);
    }
  }
  if (guards != nullptr)
    conditions.assign(guards->guard_conditions, guards->guard_conditions + guards->guard_condition_count);
  rmw_subscriptions_t subscriptions{subscribers.size(), subscribers.data()};
  rmw_guard_conditions_t guard_conditions{conditions.size(), conditions.data()};
  const bool polls = pending_ && router_ != matched_router_;
  const std::chrono::nanoseconds longest = polls ? kMatchPoll : kIdlePoll;
  const rmw_time_t timeout{0, static_cast<std::uint64_t>(longest.count())};
  const rmw_ret_t result =
      SKEIN_REAL(rmw_wait)(&subscriptions, &guard_conditions, nullptr, nullptr, nullptr, wait_set_, &timeout);
  if (result == RMW_RET_TIMEOUT) {
    if (!polls) look_for_server();
    report_waiting();
  } else if (result != RMW_RET_OK) {
    fail(std::string("cannot wait: ") + rmw_get_error_string().str);
  }
  const auto triggered = [](const void* condition) { return condition != nullptr; };
  *interrupted = std::any_of(conditions.begin(), conditions.end(), triggered);
  if (*interrupted) std::copy(conditions.begin(), conditions.end(), guards->guard_conditions);
}

void Member::read_steps() {
  skein_msgs::msg::Step step;
  rmw_message_info_t info;
  while (!over_ && take(steps_, step, info)) {
    if (step.run == setup_.run && writers_.of(steps_, info) == server_) on_step(std::move(step));
  }
}

void Member::on_step(skein_msgs::msg::Step step) {
  if (step_ && step.k == step_->k) {  // the server repeats it: the answer may be lost
    if (last_done_) publish(done_, *last_done_);
    return;
  }
  for (const auto& order : step.orders) {
    if (order.source == self_) obey(order.order);
  }
  const bool ours = std::any_of(step.members.begin(), step.members.end(),
                                [&](const auto& other) { return other.source == self_ && other.name == setup_.uav; });
  if (!ours) {
    if (member_) fail("sim_server goes on without this node");
    // The server pauses from the invitation until this node has joined, or until it gives the node up.
    if (!invited_after_ || step.k > *invited_after_) fail("sim_server gave this node up while it joined");
    return;
  }
  member_ = true;
  router_ = 0;
  for (const auto& other : step.members) {
    if (other.name == "comm_router") router_ = other.source;
  }
  for (const auto& incoming : incomings_) {
    if (incoming->counterpart() == Counterpart::none) continue;
    const Source source = source_of(incoming->counterpart());
    for (const auto& count : step.expected) {
      if (count.source == source && count.topic == "rt" + incoming->topic()) incoming->expect(source, count.count);
    }
  }
  pending_ = std::move(step);
}

void Member::obey(const std::string& order) {
  if (order == "stop") {
    // The launcher itself stops and continues a user's program. Only a new participant may come back. It may send the
    // hello at once: the server invites it when the fault is over.
    say("a fault stops this program: it starts again");
    start_again();
  }
  say("a fault kills this program");
  ::raise(SIGKILL);
  exit_at_once(128 + SIGKILL);  // Linux protects the first process of a PID namespace from its own SIGKILL
}

bool Member::step_is_here() {
  if (!pending_) return false;
  bool complete = true;
  for (const auto& incoming : incomings_) {
    if (incoming->counterpart() == Counterpart::none) continue;
    incoming->drain(writers_, source_of(incoming->counterpart()));
    complete = complete && incoming->complete();
  }
  return complete && router_matched();
}

Member::Wait Member::begin_turn(rmw_guard_conditions_t* guards) {
  if (!declared_) declare();
  waiting_since_ = said_at_ = steady_clock::now();
  for (bool interrupted = false;;) {
    read_steps();
    if (step_is_here()) break;
    wait_a_little(guards, &interrupted);
    if (interrupted || (interrupted_ && guards == nullptr)) return Wait::interrupted;
  }
  step_ = std::move(pending_);
  pending_.reset();
  now_ns_ = ns(step_->stamp);
  for (const auto& incoming : incomings_) incoming->release();
  take_in_captures();
  in_turn_ = true;
  return Wait::stepped;
}

void Member::take_in_captures() {
  if (captures_ == nullptr) return;
  while (captures_->has_sample()) {
    skein_msgs::msg::CaptureReports reports;
    if (read(captures_->take(), reports)) custody_.take(reports);
  }
  while (neighbours_->has_sample()) {
    sensor_msgs::msg::PointCloud2 cloud;
    if (read(neighbours_->take(), cloud)) custody_.see(cloud);
  }
  std::vector<std::uint64_t> stored;
  while (acks_->has_sample()) {
    skein_msgs::msg::CaptureAck ack;
    if (!read(acks_->take(), ack)) continue;
    const auto captures = custody_.acknowledge(ack);
    stored.insert(stored.end(), captures.begin(), captures.end());
  }
  if (stored.empty()) return;
  const skein_msgs::msg::CaptureAck ack = custody_.ack_of(std::move(stored));
  stored_->hold(stored_->codec().encode(&ack));
}

void Member::send_captures(std::uint64_t k) {
  if (reports_ == nullptr || router_ == 0) return;
  const skein_msgs::msg::CaptureReports reports = custody_.due(k);
  if (!reports.reports.empty()) reports_->hold(reports_->codec().encode(&reports));
}

void Member::end_turn() {
  in_turn_ = false;
  send_captures(step_->k);
  // While the router is away there is no radio: radio messages are lost.
  for (const auto& outgoing : outgoings_)
    outgoing->flush(outgoing->counterpart() == Counterpart::router && router_ == 0);
  answer(*step_);
  if (step_->final_step) leave();
}

void Member::answer(const skein_msgs::msg::Step& step) {
  skein_msgs::msg::Done done;
  done.run = setup_.run;
  done.k = step.k;
  done.epoch = step.epoch;
  done.member = setup_.uav;
  for (const auto& outgoing : outgoings_) {
    if (outgoing->counterpart() == Counterpart::none) continue;
    skein_msgs::msg::TopicCount count;
    count.topic = "rt" + outgoing->topic();
    count.source = self_;
    count.count = outgoing->sent();
    const auto same =
        std::find_if(done.sent.begin(), done.sent.end(), [&](const auto& other) { return other.topic == count.topic; });
    if (same == done.sent.end()) {
      done.sent.push_back(count);
    } else {
      same->count += count.count;
    }
  }
  publish(done_, done);
  last_done_ = std::move(done);
}

/// Waits until the server has gone: if this process ended at once, its last answer might not arrive.
void Member::leave() {
  const auto since = steady_clock::now();
  while (publishes(node_, steps_->topic_name, server_) && steady_clock::now() - since < kLinger) {
    read_steps();
    sleep_really(kMatchPoll);
  }
  over_ = true;
  end_node();
}

void Member::look_for_server() {
  if (publishes(node_, steps_->topic_name, server_)) return;
  if (member_) fail("sim_server has gone");
  say("the run is over, without this node");
  exit_at_once(0);
}

std::string Member::waiting_for() const {
  if (server_ == 0) {
    const char* const domain = std::getenv("ROS_DOMAIN_ID");
    return std::string("an invitation from sim_server in domain ") + (domain == nullptr ? "0" : domain);
  }
  if (!declared_) return "topics to match with sim_server";
  if (!member_) return "the first step";
  if (!pending_) return "the next step";
  std::string missing;
  for (const auto& incoming : incomings_) {
    if (!incoming->complete()) missing += " " + incoming->topic() + " " + incoming->missing() + ";";
  }
  return missing.empty() ? "topics to match with the router" : "samples announced by sim_server:" + missing;
}

void Member::report_waiting() {
  const auto now = steady_clock::now();
  if (now - said_at_ < kNotice) return;
  said_at_ = now;
  const auto waited = std::chrono::duration_cast<seconds>(now - waiting_since_).count();
  say("waiting for " + waiting_for() + " (" + std::to_string(waited) + " s)");
}

}  // namespace skein_ros
