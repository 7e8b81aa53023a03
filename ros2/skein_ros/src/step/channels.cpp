#include "channels.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>

#include "lockstep_qos.hpp"
#include "real_rmw.hpp"
#include "say.hpp"
#include "serialized_buffer.hpp"

namespace skein_ros {

Incoming::Incoming(rmw_subscription_t* subscription, const rosidl_message_type_support_t* type, Counterpart counterpart,
                   int depth, bool latched)
    : subscription_(subscription),
      codec_(type),
      counterpart_(counterpart),
      depth_(depth),
      latched_(latched),
      made_ns_(std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count()) {}

bool Incoming::is_for_us(const rmw_message_info_t& info) {
  if (!latched_ && !up_to_date_ && may_be_repeated(info) && info.source_timestamp < made_ns_) return false;
  up_to_date_ = true;
  return true;
}

void Incoming::set_base(Source source, std::uint64_t count) {
  // The node receives latched samples again, as far as the history reaches: these count again.
  const std::uint64_t repeated = latched_ ? std::min<std::uint64_t>(count, static_cast<std::uint64_t>(depth_)) : 0;
  base_[source] = count - repeated;
}

void Incoming::change_source(Source source) {
  if (source == source_) return;
  source_ = source;
  up_to_date_ = false;
  waiting_.clear();
  const auto base = base_.find(source);
  arrived_ = released_ = expected_ = base == base_.end() ? 0 : base->second;
}

void Incoming::drain(Writers& writers, Source source) {
  change_source(source);
  static SerializedBuffer buffer;  // reused for each sample
  for (bool taken = true; taken;) {
    rmw_message_info_t info = rmw_get_zero_initialized_message_info();
    if (SKEIN_REAL(rmw_take_serialized_message_with_info)(subscription_, buffer.get(), &taken, &info, nullptr) !=
        RMW_RET_OK) {
      rmw_reset_error();
      return;
    }
    if (!taken || source_ == 0 || writers.of(subscription_, info) != source_ || !is_for_us(info)) continue;
    ++arrived_;
    waiting_.push_back({buffer.bytes(), info});
  }
}

void Incoming::expect(Source source, std::uint64_t count) {
  change_source(source);
  expected_ = count;
}

std::string Incoming::missing() const { return std::to_string(arrived_) + " of " + std::to_string(expected_); }

void Incoming::release() {
  for (; released_ < expected_ && !waiting_.empty(); ++released_) {
    ready_.push_back(std::move(waiting_.front()));
    waiting_.pop_front();
  }
}

Sample Incoming::take() {
  Sample sample = std::move(ready_.front());
  ready_.pop_front();
  return sample;
}

void Outgoing::flush(bool lost) {
  std::size_t sent = 0;
  for (const auto& bytes : held_) {
    if (lost) continue;
    if (sent == static_cast<std::size_t>(depth_)) {
      say_once("a step may have " + std::to_string(depth_) + " samples on " + topic() +
               ": what the node publishes beyond that is not sent");
      continue;
    }
    const rmw_serialized_message_t view = view_of(bytes);
    send_heartbeat(publisher_);
    if (SKEIN_REAL(rmw_publish_serialized_message)(publisher_, &view, nullptr) != RMW_RET_OK) {
      fail("cannot publish on " + topic() + ": " + rmw_get_error_string().str);
    }
    ++sent;
    ++sent_;
  }
  held_.clear();
}

}  // namespace skein_ros
