// The counting on which lock-step rests: writers that count what they sent, queues that hand out exactly what was
// announced, in the order in which it was announced, whatever the order of arrival.
// Threads: none of this is shared; all calls from the thread that dispatches the inbox.
#pragma once

#include <deque>
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

/// "So many samples of this topic has this participant written": what announces are made of.
msg::TopicCount topic_count(const std::string& topic, ParticipantId source, std::uint64_t count);

/// True when `who` is among the participants that an endpoint has matched.
bool contains(const std::vector<ParticipantId>& matched, ParticipantId who);

/// A writer that counts its samples since it was made, and refuses more in one step than its history can hold:
/// beyond that a reader might lose one, and the count would never come out.
class CountedWriter {
 public:
  /// @param ear  hears what is written.
  CountedWriter(Participant& participant, TopicSpec topic, Ear ear = {});

  /// @returns false when this step's share of the history is used up; the sample is not sent then, and counted by the
  /// participant's unsent().
  bool write(std::span<const std::uint8_t> payload);
  template <WireMessage Message>
  bool write(const Message& message) {
    return write(encode(message));
  }
  /// Counts a sample that nobody reads without the cost of building it; see is_wanted().
  void skip() { ++count_; }

  bool has_readers() const { return writer_->has_readers(); }
  /// Somebody reads it, or it is recorded all the same.
  bool is_wanted() const { return ear_.also_unread || has_readers(); }
  bool matches(ParticipantId who) const { return contains(writer_->matched(), who); }
  std::uint64_t count() const { return count_; }
  const std::string& topic() const { return topic_.name; }
  bool latched() const { return topic_.qos.latched; }
  /// A new step: the history has room again.
  void begin_step() { step_start_ = count_; }

 private:
  TopicSpec topic_;
  Ear ear_;
  Unsent& unsent_;
  std::unique_ptr<Writer> writer_;
  std::uint64_t count_ = 0, step_start_ = 0;
};

/// Samples of some topics, kept apart by writer until they are called for.
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
  /// The writer had already sent `count` samples when we began to listen.
  void set_base(const std::string& topic, ParticipantId source, std::uint64_t count);
  void arrive(const std::string& topic, Sample&& sample);
  /// What must have arrived; topics that were never added are left out. Replaces the former expectation.
  void expect(const std::vector<Expected>& expected);
  bool complete() const;
  /// Runs the handlers for all that is expected and not yet handed out, in the order of expect(), then of writing.
  void release();
  /// Forgets a source: what it sent, and what is expected of it.
  void discard(ParticipantId source);
  struct Surplus {
    std::string topic;
    std::uint64_t announced = 0, arrived = 0;  ///< cumulative, since the source joined
  };
  /// Where more has arrived from a source than is expected of it; the first such topic.
  std::optional<Surplus> surplus(ParticipantId source) const;
  /// What is still missing of all sources, or of one, for a human: "rt/x 3 of 4".
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
