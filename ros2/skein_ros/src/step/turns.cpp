#include "turns.hpp"

#include <pthread.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <thread>
#include <vector>

#include "leaving.hpp"
#include "real_rmw.hpp"
#include "say.hpp"

namespace skein_ros {
namespace {

/// If a node only polls (spin_some() without a sleep), its step ends after so many successive polls that found nothing.
constexpr int kIdlePolls = 2;
/// Only a timer with period 0 is due so often within one step.
constexpr int kMostTimerCalls = 100'000;
constexpr std::int64_t kForever = std::numeric_limits<std::int64_t>::max();

std::atomic<std::thread::id> node_thread;
thread_local bool node_code = false;
int idle_polls = 0, timer_calls = 0;

/// While an InStep exists, in_node_code() is false in its thread.
class InStep {
 public:
  InStep() { node_code = false; }
  ~InStep() { node_code = true; }
};

void begin_step() { idle_polls = timer_calls = 0; }

Member::Wait next_step(Member& me, rmw_guard_conditions_t* guards) {
  if (me.in_turn()) {
    node_code = true;
    me.plan();
    node_code = false;
    me.end_turn();
  }
  if (me.is_over()) return Member::Wait::stepped;
  const Member::Wait how = me.begin_turn(guards);
  begin_step();
  return how;
}

Incoming* incoming_of(Member& me, const void* data) {
  for (const auto& incoming : me.incomings()) {
    if (incoming->subscription()->data == data) return incoming.get();
  }
  return nullptr;
}

/// Leaves in the list the subscriptions that have a sample. If /clock has one, it leaves only /clock, so that the node
/// knows the time when it reads the others.
bool mark_ready(Member& me, const rmw_subscriptions_t* asked, rmw_subscriptions_t* subscriptions) {
  if (subscriptions == nullptr) return false;
  const auto has_sample = [&](void* data) {
    const Incoming* const incoming = incoming_of(me, data);
    return incoming != nullptr && incoming->has_sample();
  };
  bool any = false, clock = false;
  for (std::size_t i = 0; i < asked->subscriber_count; ++i) {
    if (!has_sample(asked->subscribers[i])) continue;
    any = true;
    clock = clock || incoming_of(me, asked->subscribers[i])->topic() == "/clock";
  }
  for (std::size_t i = 0; i < asked->subscriber_count; ++i) {
    void* const data = asked->subscribers[i];
    const bool ready = has_sample(data) && (!clock || incoming_of(me, data)->topic() == "/clock");
    subscriptions->subscribers[i] = ready ? data : nullptr;
  }
  return any;
}

bool any(void* const* entries, std::size_t count) {
  return std::any_of(entries, entries + count, [](const void* entry) { return entry != nullptr; });
}

template <class List>
void clear(List* list, std::size_t count, void** entries) {
  if (list != nullptr) std::fill_n(entries, count, nullptr);
}

/// What an executor waits for. It is kept here for repeated looks, because rmw_wait() clears what is not ready.
class Look {
 public:
  Look(rmw_subscriptions_t* subscriptions, rmw_guard_conditions_t* guards, rmw_services_t* services,
       rmw_clients_t* clients, rmw_events_t* events, rmw_wait_set_t* wait_set)
      : subscriptions_(subscriptions), guards_(guards), events_(events), wait_set_(wait_set) {
    if (subscriptions != nullptr)
      asked_.assign(subscriptions->subscribers, subscriptions->subscribers + subscriptions->subscriber_count);
    if (guards != nullptr)
      guards_asked_.assign(guards->guard_conditions, guards->guard_conditions + guards->guard_condition_count);
    if (events != nullptr) events_asked_.assign(events->events, events->events + events->event_count);
    // Calls of the node's services and answers to its clients come at any time: they are not in the lock-step.
    if (services != nullptr) clear(services, services->service_count, services->services);
    if (clients != nullptr) clear(clients, clients->client_count, clients->clients);
  }

  /// @returns whether something is ready
  bool now(Member& me) {
    restore();
    const rmw_time_t none{0, 0};
    const rmw_ret_t found = SKEIN_REAL(rmw_wait)(nullptr, guards_, nullptr, nullptr, events_, wait_set_, &none);
    if (found != RMW_RET_OK && found != RMW_RET_TIMEOUT) rmw_reset_error();
    const rmw_subscriptions_t asked{asked_.size(), asked_.data()};
    const bool samples = mark_ready(me, &asked, subscriptions_);
    // The result of rmw_wait() does not tell: with Fast DDS it is OK if there was nothing to wait for.
    return samples || (guards_ != nullptr && any(guards_->guard_conditions, guards_asked_.size())) ||
           (events_ != nullptr && any(events_->events, events_asked_.size()));
  }
  /// Leaves only the guard conditions that were triggered while the member waited for the next step.
  void nothing_but_guards() {
    if (subscriptions_ != nullptr) clear(subscriptions_, asked_.size(), subscriptions_->subscribers);
    if (events_ != nullptr) clear(events_, events_asked_.size(), events_->events);
  }
  rmw_guard_conditions_t* guards_to_wait_for() {
    restore();
    return guards_;
  }

 private:
  void restore() {
    if (guards_ != nullptr) std::copy(guards_asked_.begin(), guards_asked_.end(), guards_->guard_conditions);
    if (events_ != nullptr) std::copy(events_asked_.begin(), events_asked_.end(), events_->events);
  }
  rmw_subscriptions_t* const subscriptions_;
  rmw_guard_conditions_t* const guards_;
  rmw_events_t* const events_;
  rmw_wait_set_t* const wait_set_;
  std::vector<void*> asked_, guards_asked_, events_asked_;
};

std::int64_t deadline_of(const Member& me, const rmw_time_t* timeout) {
  if (timeout == nullptr) return kForever;
  constexpr std::uint64_t kLongest_s = 1'000'000'000;
  if (timeout->sec > kLongest_s) return kForever;
  return me.now_ns() + static_cast<std::int64_t>(timeout->sec) * 1'000'000'000 +
         static_cast<std::int64_t>(timeout->nsec);
}

std::string name_of_thread() {
  char name[32] = "";
  ::pthread_getname_np(::pthread_self(), name, sizeof name);
  return name;
}

}  // namespace

Member* member() {
  static const std::unique_ptr<Member> mine = [] {
    auto setup = setup_of_environment();
    return setup ? std::make_unique<Member>(std::move(*setup)) : nullptr;
  }();
  return mine.get();
}

bool in_node_code() { return node_code; }
void enter_node_code() { node_code = true; }

void note_work() { idle_polls = 0; }

void note_timer() {
  idle_polls = 0;
  if (++timer_calls > kMostTimerCalls) fail("a timer is due without end within one step; its period must not be 0");
}

bool simulated_now(std::int64_t* now_ns) {
  const Member* const me = member();
  if (me == nullptr || !me->is_open()) return false;
  *now_ns = me->now_ns();
  return true;
}

void require_node_thread(const char* what) {
  std::thread::id none;
  const std::thread::id mine = std::this_thread::get_id();
  if (node_thread.compare_exchange_strong(none, mine) || none == mine) return;
  fail(std::string("refused: the node ") + what + " in a second thread (" + name_of_thread() +
       "). In the lock-step a node works in one thread: use a SingleThreadedExecutor and no threads of your own "
       "(docs/ros2.md)");
}

bool sleep_until_simulated(std::int64_t until_ns) {
  Member* const me = member();
  if (me == nullptr || !me->is_open()) return false;
  require_node_thread("sleeps");
  const InStep in_step;
  while (!me->is_over() && me->now_ns() < until_ns) {
    if (next_step(*me, nullptr) == Member::Wait::interrupted) return false;
  }
  if (me->is_over()) count_work_after_end();
  return !me->is_over();
}

rmw_ret_t wait_in_step(rmw_subscriptions_t* subscriptions, rmw_guard_conditions_t* guards, rmw_services_t* services,
                       rmw_clients_t* clients, rmw_events_t* events, rmw_wait_set_t* wait_set,
                       const rmw_time_t* timeout) {
  Member& me = *member();
  const InStep in_step;
  Look look(subscriptions, guards, services, clients, events, wait_set);
  const std::int64_t deadline = deadline_of(me, timeout);
  const bool polls = deadline <= me.now_ns();
  for (;;) {
    if (me.is_over()) {
      const bool any = look.now(me);
      count_work_after_end();
      return any ? RMW_RET_OK : RMW_RET_TIMEOUT;
    }
    if (me.in_turn()) {
      if (look.now(me)) return RMW_RET_OK;
      if (polls ? ++idle_polls < kIdlePolls : me.now_ns() >= deadline) return RMW_RET_TIMEOUT;
    }
    if (next_step(me, look.guards_to_wait_for()) == Member::Wait::interrupted) {
      look.nothing_but_guards();
      return RMW_RET_OK;
    }
    // A poll returns after one step; any other wait goes on until something is ready or its timeout has passed.
    if (polls) return look.now(me) ? RMW_RET_OK : RMW_RET_TIMEOUT;
  }
}

}  // namespace skein_ros
