// Writers and subscriptions of messages instead of bytes. A thin layer: everything about order, threads and quality of
// service is as bus.hpp and inbox.hpp say.
#pragma once

#include <spdlog/spdlog.h>

#include <atomic>
#include <concepts>
#include <cstdint>
#include <functional>
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

/// Writes messages and counts them, as lock-step wants it. From one thread at a time.
template <class T>
class TypedWriter {
 public:
  TypedWriter(Participant& participant, std::string name, const Qos& qos = {})
      : name_(std::move(name)), writer_(participant.create_writer(topic_of<T>(name_, qos))) {}

  void write(const T& message) {
    writer_->write(encode(message));
    ++count_;
  }

  /// Samples written since construction.
  std::uint64_t count() const { return count_; }
  const std::string& name() const { return name_; }
  std::vector<ParticipantId> matched() const { return writer_->matched(); }
  Writer& raw() { return *writer_; }

 private:
  std::string name_;
  std::unique_ptr<Writer> writer_;
  std::uint64_t count_ = 0;
};

/// A subscription; ends when it is destroyed, before its inbox and its participant.
class TypedReader : public Reader {
 public:
  TypedReader(std::unique_ptr<Reader> reader, std::shared_ptr<const std::atomic<std::uint64_t>> malformed)
      : reader_(std::move(reader)), malformed_(std::move(malformed)) {}

  std::vector<ParticipantId> matched() const override { return reader_->matched(); }
  /// Samples that were no message of this type, and were dropped.
  std::uint64_t malformed() const { return *malformed_; }

 private:
  std::unique_ptr<Reader> reader_;
  std::shared_ptr<const std::atomic<std::uint64_t>> malformed_;
};

/// Calls `handler` inside inbox.dispatch() for each message on a topic, with the participant that wrote it.
/// Malformed samples are dropped and counted; the first of them is logged.
template <class T, class Handler>
requires std::invocable<Handler&, const T&, ParticipantId> std::unique_ptr<TypedReader> subscribe(
    Inbox& inbox, Participant& participant, const TopicSpec& topic, Handler handler) {
  auto malformed = std::make_shared<std::atomic<std::uint64_t>>(0);
  auto reader = inbox.subscribe(
      participant, topic, [name = topic.name, malformed, handler = std::move(handler)](Sample&& sample) mutable {
        T message;
        if (decode(sample.payload, message))
          handler(std::as_const(message), sample.source);
        else if ((*malformed)++ == 0)
          spdlog::warn(
              "{}: dropped a malformed sample of {} bytes from participant {:016x}; further ones are only "
              "counted",
              name, sample.payload.size(), sample.source);
      });
  return std::make_unique<TypedReader>(std::move(reader), std::move(malformed));
}

/// The same for the topic `name` of messages T.
template <class T, class Handler>
requires std::invocable<Handler&, const T&, ParticipantId> std::unique_ptr<TypedReader> subscribe(
    Inbox& inbox, Participant& participant, std::string name, const Qos& qos, Handler handler) {
  return subscribe<T>(inbox, participant, topic_of<T>(std::move(name), qos), std::move(handler));
}

}  // namespace skein::bus
