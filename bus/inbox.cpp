#include "bus/inbox.hpp"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdlib>
#include <iterator>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

namespace skein::bus {

namespace {

using Clock = std::chrono::steady_clock;

/// One subscription. Once its reader is destroyed, waiting samples for it are dropped.
struct Subscription {
  Inbox::Handler handler;
  Bell bell = Bell::rings;
  std::atomic<bool> alive = true;
};

/// A sample that has arrived for a subscription, or posted work.
struct Arrival {
  std::shared_ptr<Subscription> subscription;
  Sample sample;
  std::function<void()> work;

  bool rings() const { return subscription && subscription->bell == Bell::rings; }

  void run() {
    if (work)
      work();
    else if (subscription->alive)
      subscription->handler(std::move(sample));
  }
};

/// Identifies a stream: a sequence of arrivals that SKEIN_CHAOS may delay, but never reorders. One participant's
/// samples for one subscription form a stream; all posted work together forms another.
using Stream = std::pair<const Subscription*, ParticipantId>;

unsigned chaos_of_environment() {
  const char* value = std::getenv("SKEIN_CHAOS");
  return value == nullptr ? 0 : static_cast<unsigned>(std::strtoul(value, nullptr, 10));
}

/// Random delays of arrivals under SKEIN_CHAOS: half of them are 0, most others are below 0.3 ms, which is less than a
/// step takes, and a few are up to 3 ms. The generator is SplitMix64 (Steele, Lea and Flood 2014).
class ChaosDelay {
 public:
  explicit ChaosDelay(unsigned seed) : state_((std::uint64_t{seed} << 32) ^ static_cast<std::uint64_t>(getpid())) {}

  std::chrono::microseconds next() {
    const std::uint64_t bits = random();
    if ((bits & 1) == 0) return {};
    const std::uint64_t longest_us = (bits & 0x1e) == 0 ? 3000 : 300;
    return std::chrono::microseconds((bits >> 8) % longest_us);
  }

 private:
  std::uint64_t random() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
};

}  // namespace

/// Arrivals wait in `ready`; under chaos they first wait in `held` until they are due.
struct Inbox::Impl {
  explicit Impl(unsigned chaos_seed) : chaos(chaos_seed != 0), delay(chaos_seed) {}

  void push(Arrival&& arrival) {
    {
      const std::scoped_lock lock(mutex);
      if (deaf && !arrival.work) return;
      if (chaos)
        hold(std::move(arrival));
      else
        add(std::move(arrival));
      // Under chaos, wake the waiting thread in any case: the first held arrival may now be due earlier.
      if (!waiting || !(chaos || enough(wanted_rings))) return;
      waiting = false;  // one notification is enough
    }
    changed.notify_one();
  }

  void add(Arrival&& arrival) {
    if (arrival.work) posted = true;
    if (arrival.rings()) ++rings;
    ready.push_back(std::move(arrival));
  }

  bool enough(std::size_t wanted) const { return posted || woken || (wanted == 0 ? !ready.empty() : rings >= wanted); }

  /// Takes all arrivals from `ready`.
  std::vector<Arrival> take() {
    rings = 0;
    posted = false;
    return std::exchange(ready, {});
  }

  /// Delays an arrival. It is never due before an earlier one of its stream; a multimap keeps the order of equal times.
  void hold(Arrival&& arrival) {
    const Stream stream{arrival.subscription.get(), arrival.sample.source};
    Clock::time_point& last = last_due[stream];
    last = std::max(last, Clock::now() + delay.next());
    held.emplace(last, std::move(arrival));
  }

  /// Moves due arrivals from `held` to `ready`.
  void release() {
    const auto end = held.upper_bound(Clock::now());
    for (auto it = held.begin(); it != end; ++it) add(std::move(it->second));
    held.erase(held.begin(), end);
  }

  /// Waits until enough arrivals are ready, wake() was called, or the deadline has passed.
  void wait(std::unique_lock<std::mutex>& lock, Clock::time_point deadline, std::size_t wanted) {
    wanted_rings = wanted;
    for (;;) {
      release();
      if (enough(wanted) || Clock::now() >= deadline) break;
      waiting = true;
      changed.wait_until(lock, held.empty() ? deadline : std::min(deadline, held.begin()->first));
    }
    waiting = false;
  }

  const bool chaos;
  std::mutex mutex;
  std::condition_variable changed;
  std::vector<Arrival> ready;
  std::size_t rings = 0;  ///< ringing arrivals in `ready`
  bool posted = false;    ///< `ready` contains posted work
  bool waiting = false;   ///< a thread waits and has not been notified yet
  std::size_t wanted_rings = 0;
  bool woken = false;
  bool deaf = false;

  ChaosDelay delay;
  std::multimap<Clock::time_point, Arrival> held;
  std::map<Stream, Clock::time_point> last_due;
};

namespace {

class InboxReader : public Reader {
 public:
  InboxReader(std::shared_ptr<Subscription> subscription, std::unique_ptr<Reader> reader)
      : subscription_(std::move(subscription)), reader_(std::move(reader)) {}
  ~InboxReader() override { subscription_->alive = false; }

  std::vector<ParticipantId> matched() const override { return reader_->matched(); }

 private:
  std::shared_ptr<Subscription> subscription_;
  std::unique_ptr<Reader> reader_;
};

}  // namespace

Inbox::Inbox(RunId run) : Inbox(chaos_of_environment(), run) {}

Inbox::Inbox(unsigned chaos, RunId run) : impl_(std::make_unique<Impl>(chaos)), run_(run) {}

Inbox::~Inbox() = default;

std::unique_ptr<Reader> Inbox::subscribe(Participant& participant, const TopicSpec& topic, Handler handler, Bell bell) {
  auto subscription = std::make_shared<Subscription>();
  subscription->handler = std::move(handler);
  subscription->bell = bell;
  auto reader = participant.create_reader(topic, [impl = impl_.get(), subscription](Sample&& sample) {
    impl->push({subscription, std::move(sample), nullptr});
  });
  return std::make_unique<InboxReader>(std::move(subscription), std::move(reader));
}

bool Inbox::dispatch(std::chrono::milliseconds timeout, std::size_t rings) {
  std::vector<Arrival> batch;
  bool woken = false;
  {
    std::unique_lock lock(impl_->mutex);
    impl_->wait(lock, Clock::now() + timeout, rings);
    batch = impl_->take();
    woken = std::exchange(impl_->woken, false);
  }
  std::size_t done = 0;
  try {
    while (done < batch.size()) batch[done++].run();
  } catch (...) {
    // The caller gets the handler's exception. The arrivals that were not handled yet stay in the inbox.
    const std::scoped_lock lock(impl_->mutex);
    std::vector<Arrival> later = impl_->take();
    for (; done < batch.size(); ++done) impl_->add(std::move(batch[done]));
    for (Arrival& arrival : later) impl_->add(std::move(arrival));
    throw;
  }
  return !batch.empty() && !woken;
}

bool Inbox::ready(std::size_t rings) {
  const std::scoped_lock lock(impl_->mutex);
  impl_->release();
  return impl_->enough(rings);
}

void Inbox::wake() {
  const std::scoped_lock lock(impl_->mutex);
  impl_->woken = true;
  impl_->changed.notify_one();
}

void Inbox::post(std::function<void()> work) { impl_->push({nullptr, {}, std::move(work)}); }

void Inbox::set_deaf(bool deaf) {
  const std::scoped_lock lock(impl_->mutex);
  impl_->deaf = deaf;
}

void Inbox::note_malformed(const std::string& topic, const Sample& sample) {
  ++malformed_;
  if (!told_.insert(topic).second) return;
  spdlog::warn("{}: dropped a malformed sample of {} bytes from participant {:016x}; further ones are only counted",
               topic, sample.payload.size(), sample.source);
}

void Inbox::note_foreign(const std::string& topic, const Sample& sample, RunId run) {
  if (!told_foreign_.insert(topic).second) return;
  spdlog::warn("{}: participant {:016x} takes part in another run ({}, not {}) and is ignored", topic, sample.source,
               static_cast<std::uint64_t>(run), static_cast<std::uint64_t>(run_));
}

}  // namespace skein::bus
