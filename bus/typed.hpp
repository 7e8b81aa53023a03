// Topics and subscriptions with message types instead of bytes. A thin layer: for order, threads and quality of service
// see bus.hpp and inbox.hpp.
#pragma once

#include <concepts>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bus/bus.hpp"
#include "bus/inbox.hpp"
#include "idl/cdr.hpp"
#include "idl/type_names.hpp"

namespace skein::bus {

/// The topic `name` (as on the wire: "rt/jurong/gimbal") of messages T.
template <class T>
TopicSpec topic_of(std::string name, const Qos& qos = {}) {
  return {std::move(name), type_name<T>(), qos};
}

/// Messages of the lock-step: they say which run they belong to.
template <class T>
concept OfOneRun = requires(T message) {
  { message.run() } -> std::convertible_to<std::uint64_t>;
};

/// An empty message of a run.
template <OfOneRun T>
T message_of(RunId run) {
  T message;
  message.run(static_cast<std::uint64_t>(run));
  return message;
}

/// Makes a handler of raw samples that decodes them and calls `handler` with (message) or (message, participant that
/// wrote it). Samples that do not decode as T are dropped; `inbox`, which must outlive the handler, counts them and
/// logs the first on each topic. Messages of another run are dropped and logged, too, but not counted: they are no
/// error.
template <class T, class Handler>
Inbox::Handler decoding(Inbox& inbox, std::string topic, Handler handler) {
  return [&inbox, topic = std::move(topic), handler = std::move(handler)](Sample&& sample) mutable {
    T message;
    if (!decode(sample.payload, message)) {
      inbox.note_malformed(topic, sample);
      return;
    }
    if constexpr (OfOneRun<T>) {
      if (const RunId run{message.run()}; run != inbox.run()) {
        inbox.note_foreign(topic, sample, run);
        return;
      }
    }
    if constexpr (std::invocable<Handler&, T&, ParticipantId>) {
      handler(message, sample.source);
    } else {
      handler(message);
    }
  };
}

/// A subscription whose samples arrive decoded, inside inbox.dispatch().
template <class T, class Handler>
std::unique_ptr<Reader> subscribe(Inbox& inbox, Participant& participant, const TopicSpec& topic, Handler handler,
                                  Bell bell = Bell::rings) {
  return inbox.subscribe(participant, topic, decoding<T>(inbox, topic.name, std::move(handler)), bell);
}

}  // namespace skein::bus
