#include "uav_agent/client/relay.hpp"

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "idl/cdr.hpp"

namespace skein::agent {
namespace {

/// Stamps are in nanoseconds, and are compared in seconds. Numeric.
constexpr double kTolerance_s = 1e-6;

struct Content {
  bool valid = true;
  std::optional<double> stamp_s = {};  ///< of its header; nullopt: it has none, or a stamp of zero
};

template <class Message>
Content content_of(std::span<const std::uint8_t> payload) {
  Message message;
  if (!decode(payload, message)) return {.valid = false};
  if constexpr (requires { message.header().stamp(); }) {
    const auto& stamp = message.header().stamp();
    constexpr double kNanosecond = 1e-9;  // format of stamps
    if (stamp.sec() != 0 || stamp.nanosec() != 0) return {.stamp_s = stamp.sec() + kNanosecond * stamp.nanosec()};
  }
  return {};
}

template <class... Messages>
auto content_by_type() {
  return std::map<std::string, std::function<Content(std::span<const std::uint8_t>)>>{
      {type_name<Messages>(), content_of<Messages>}...};
}

Content content(const std::string& type, std::span<const std::uint8_t> payload) {
  static const auto kReaders = content_by_type<msg::MultiDOFJointTrajectory, msg::Twist, msg::BoolStamped,
                                               msg::Activity, msg::Float64, msg::String>();
  const auto reader = kReaders.find(type);
  return reader == kReaders.end() ? Content{} : reader->second(payload);
}

}  // namespace

Relay::Relay(topics::WireTopic topic, double exchange_s)
    : topic_(std::move(topic)), late_after_s_(2.0 * exchange_s + kTolerance_s) {}

void Relay::hear(Payload payload) {
  ++received_;
  if (!content(topic_.type, payload).valid) {
    ++refused_;
    return;
  }
  if (waiting_.size() == static_cast<std::size_t>(topic_.depth)) {
    waiting_.pop_front();
    ++lost_;
  }
  waiting_.push_back(std::move(payload));
}

void Relay::forget() {
  lost_ += waiting_.size();
  waiting_.clear();
}

std::vector<Relay::Payload> Relay::take(double now_s) {
  std::vector<Payload> all;
  for (Payload& payload : std::exchange(waiting_, {})) {
    judge(payload, now_s);
    all.push_back(std::move(payload));
  }
  handed_on_ += all.size();
  return all;
}

// A node that stamps with the wall clock is decades ahead of simulated time.
void Relay::judge(const Payload& payload, double now_s) {
  const std::optional<double> stamp_s = content(topic_.type, payload).stamp_s;
  if (!stamp_s) return;
  if (*stamp_s > now_s + late_after_s_) ++other_clock_;
  if (*stamp_s < now_s - late_after_s_) ++late_;
}

RelayedTopic Relay::report() const {
  return {.topic = topic_.name.substr(std::string_view("rt").size()),
          .received = received_,
          .handed_on = handed_on_,
          .late = late_,
          .lost = lost_ + waiting_.size(),
          .refused = refused_,
          .other_clock = other_clock_};
}

}  // namespace skein::agent
