// A node's subscriptions and publishers in the lock-step: this library holds publications until the node has finished
// the step, and arrivals until all samples that the step announced are here. Threads: the node's.
#pragma once

#include <rmw/rmw.h>

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "codec.hpp"
#include "sources.hpp"

namespace skein_ros {

/// A serialised message; for an arrival, also where it came from.
struct Sample {
  std::vector<std::uint8_t> bytes;
  rmw_message_info_t info = {};
};

enum class Counterpart { server, router, none };

/// A subscription.
class Incoming {
 public:
  Incoming(rmw_subscription_t* subscription, const rosidl_message_type_support_t* type, Counterpart counterpart,
           int depth, bool latched);

  rmw_subscription_t* subscription() const { return subscription_; }
  const Codec& codec() const { return codec_; }
  std::string topic() const { return subscription_->topic_name; }
  Counterpart counterpart() const { return counterpart_; }

  /// `source` had sent `count` samples when the node was invited.
  void set_base(Source source, std::uint64_t count);
  /// Takes all samples out of the rmw, and drops those that are not from `source`.
  void drain(Writers& writers, Source source);
  /// The step announces that `source` has sent `count` samples in all.
  void expect(Source source, std::uint64_t count);
  bool complete() const { return arrived_ >= expected_; }
  /// How many of the announced samples are here, for the log: "3 of 4".
  std::string missing() const;
  /// Hands the announced samples to the node.
  void release();
  /// Hands over a sample of a publisher in this process, which is not counted.
  void hand(Sample sample) { ready_.push_back(std::move(sample)); }

  bool has_sample() const { return !ready_.empty(); }
  /// @pre has_sample()
  Sample take();

 private:
  void change_source(Source source);
  bool is_for_us(const rmw_message_info_t& info);

  rmw_subscription_t* const subscription_;
  const Codec codec_;
  const Counterpart counterpart_;
  const int depth_;
  const bool latched_;
  const std::int64_t made_ns_;  ///< time of creation on the wall clock
  bool up_to_date_ = false;     ///< source_ has sent a sample that was meant for this reader
  std::map<Source, std::uint64_t> base_;
  Source source_ = 0;
  std::uint64_t arrived_ = 0, released_ = 0, expected_ = 0;  ///< cumulative, of source_
  std::deque<Sample> waiting_, ready_;
};

/// A publisher.
class Outgoing {
 public:
  Outgoing(rmw_publisher_t* publisher, const rosidl_message_type_support_t* type, Counterpart counterpart, int depth)
      : publisher_(publisher), codec_(type), counterpart_(counterpart), depth_(depth) {}

  rmw_publisher_t* publisher() const { return publisher_; }
  const Codec& codec() const { return codec_; }
  std::string topic() const { return publisher_->topic_name; }
  Counterpart counterpart() const { return counterpart_; }

  /// Holds a sample until the end of the step.
  void hold(std::vector<std::uint8_t> bytes) { held_.push_back(std::move(bytes)); }
  /// Sends the held samples, at most as many as the history is deep; drops the rest, and logs that once.
  /// @param lost  drops all of them, because no receiver is there
  void flush(bool lost);
  std::uint64_t sent() const { return sent_; }

 private:
  rmw_publisher_t* const publisher_;
  const Codec codec_;
  const Counterpart counterpart_;
  const int depth_;
  std::vector<std::vector<std::uint8_t>> held_;
  std::uint64_t sent_ = 0;
};

}  // namespace skein_ros
