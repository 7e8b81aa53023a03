// The counting on which the lock-step is based: writers count the samples that they send; queues pass on exactly the
// announced samples, in the announced order, independent of the order of arrival.
// Threads: none of this is shared; all calls from the thread that dispatches the inbox.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "bus/inbox.hpp"
#include "bus/tap.hpp"
#include "idl/cdr.hpp"
#include "idl/type_names.hpp"

namespace skein::bus {

/// A generated message type, as opposed to bytes.
template <class T>
concept WireMessage = requires {
  TypeName<T>::kValue;
};

/// An announcement: the number of samples that a participant has written on a topic.
msg::TopicCount topic_count(const std::string& topic, ParticipantId source, std::uint64_t count);

/// True when `who` is among the participants that an endpoint has matched.
bool contains(const std::vector<ParticipantId>& matched, ParticipantId who);

/// A writer that counts its samples since its creation. In one step it sends no more samples than its history depth:
/// otherwise a reader could lose one, and would wait for the announced count for ever.
class CountedWriter {
 public:
  /// @param ear  receives a copy of each written sample.
  CountedWriter(Participant& participant, TopicSpec topic, Ear ear = {});

  /// @returns false when this step has used up the history depth. Then the sample is not sent, and the participant's
  /// unsent() counts it.
  bool write(std::span<const std::uint8_t> payload);
  template <WireMessage Message>
  bool write(const Message& message) {
    return write(encode(message));
  }
  /// Counts a sample without sending it, which saves building a sample that has no readers; see is_wanted().
  void skip() { ++count_; }

  bool has_readers() const { return writer_->has_readers(); }
  /// Whether samples must be built: the topic has readers, or it is recorded also without readers.
  bool is_wanted() const { return ear_.also_unread || has_readers(); }
  bool matches(ParticipantId who) const { return contains(writer_->matched(), who); }
  std::uint64_t count() const { return count_; }
  const std::string& topic() const { return topic_.name; }
  bool latched() const { return topic_.qos.latched; }
  /// Begins a new step, in which the whole history depth is available again.
  void begin_step() { step_start_ = count_; }

 private:
  TopicSpec topic_;
  Ear ear_;
  Unsent& unsent_;
  std::unique_ptr<Writer> writer_;
  std::uint64_t count_ = 0, step_start_ = 0;
};

/// Queues of samples, by topic and writer, which wait for release().
class CountedQueues {
 public:
  using Handler = std::function<void(Sample&&)>;
  struct Expected {
    std::string topic;
    ParticipantId source = 0;
    std::uint64_t count = 0;  ///< cumulative, since `source` joined
  };

  void add_topic(const std::string& topic, Handler handler);
  void remove_topic(const std::string& topic);
  /// Sets the initial count: the writer had already sent `count` samples when reading began.
  void set_base(const std::string& topic, ParticipantId source, std::uint64_t count);
  void arrive(const std::string& topic, Sample&& sample);
  /// Sets the expected counts, instead of the previous ones; ignores topics that were not added.
  void expect(const std::vector<Expected>& expected);
  /// Whether all expected samples have arrived.
  bool complete() const;
  /// Runs the handlers of all expected samples that are still queued: in the order of the entries in expect(), within
  /// an entry in the order of writing.
  void release();
  /// Removes a source: its queued samples and its expected counts.
  void discard(ParticipantId source);
  struct Surplus {
    std::string topic;
    std::uint64_t announced = 0, arrived = 0;  ///< cumulative, since the source joined
  };
  /// The first topic on which more samples have arrived from a source than expected; nullopt: none.
  std::optional<Surplus> surplus(ParticipantId source) const;
  /// The missing samples of all sources, or of one, as texts for people: "rt/x 3 of 4".
  std::vector<std::string> missing(std::optional<ParticipantId> source = std::nullopt) const;

 private:
  struct Lane {
    std::uint64_t arrived = 0, released = 0;  ///< cumulative, bases included
    std::deque<Sample> waiting;
  };
  struct Topic {
    Handler handler;
    std::map<ParticipantId, Lane> lanes;
  };
  std::map<std::string, Topic> topics_;
  std::vector<Expected> expected_;
};

}  // namespace skein::bus
