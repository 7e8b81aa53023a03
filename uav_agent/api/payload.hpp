// Radio messages between planners, as bytes: a writer and a reader of numbers, and the envelope in which a payload
// travels on the topic /plan: every UAV may send on it, and all nodes in line of sight receive it
// (core/radio/radio_routes.hpp). A planner puts the message from send_payload() into PlannerOutput::radio, and reads
// the messages in PlannerInput::radio with open_payloads().
// Numbers are little-endian; positions are rounded to centimetres.
// Pure.   Bounded: a payload is never longer than kMaxPayloadBytes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/types.hpp"
#include "uav_agent/api/messages.hpp"

namespace skein::agent {

/// Largest payload, without its envelope. A planner that has more to say sends several messages, or the rest later.
/// Chosen.
inline constexpr std::size_t kMaxPayloadBytes = 16'384;

/// Appends numbers; calls can be chained: PayloadWriter().u8(1).u16(goal).
class PayloadWriter {
 public:
  PayloadWriter& u8(std::uint8_t value) { return number(value, 1); }
  PayloadWriter& u16(std::uint16_t value) { return number(value, 2); }
  PayloadWriter& u32(std::uint32_t value) { return number(value, sizeof(value)); }
  /// Appends a position as three 32-bit numbers of centimetres; each coordinate must be within 20,000 km.
  PayloadWriter& position(const Vector3d& p_W);
  PayloadWriter& bytes(std::span<const std::uint8_t> bytes);

  std::size_t size() const { return bytes_.size(); }
  std::size_t room() const { return kMaxPayloadBytes - std::min(bytes_.size(), kMaxPayloadBytes); }
  const std::vector<std::uint8_t>& data() const { return bytes_; }

 private:
  PayloadWriter& number(std::uint32_t value, int width);

  std::vector<std::uint8_t> bytes_;
};

/// Reads what a PayloadWriter wrote. Reading past the end returns zeros, and ok() is false from then on: check ok()
/// before you use any value that was read.
class PayloadReader {
 public:
  explicit PayloadReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::uint8_t u8() { return static_cast<std::uint8_t>(number(1)); }
  std::uint16_t u16() { return static_cast<std::uint16_t>(number(2)); }
  std::uint32_t u32() { return number(sizeof(std::uint32_t)); }
  Vector3d position();
  /// The next `count` bytes; empty if fewer are left.
  std::span<const std::uint8_t> bytes(std::size_t count);

  bool ok() const { return ok_; }
  std::size_t left() const { return bytes_.size(); }
  /// True when all bytes were read, and no read went past the end.
  bool at_end() const { return ok_ && bytes_.empty(); }

 private:
  std::uint32_t number(int width);

  std::span<const std::uint8_t> bytes_;
  bool ok_ = true;
};

/// Length of these bytes in a message's text, where the bytes 0 and 1 are escaped and take two characters each.
std::size_t text_bytes(std::span<const std::uint8_t> bytes);

/// A payload that arrived.
struct Payload {
  std::size_t sender = 0;  ///< index in the fleet, as the message claims: the radio does not identify senders
  std::vector<std::uint8_t> bytes;
};

/// Wraps a payload into a message on /plan.
/// @param planner  name of the planner and version of its messages ("kios/1"): open_payload() compares it.
/// @throws std::logic_error when the payload is longer than kMaxPayloadBytes: the planner must prevent that.
RadioMessage send_payload(std::string_view planner, std::size_t sender, const PayloadWriter& payload);

/// @returns nullopt for a message on another topic, of another planner, damaged, too long, or with a sender outside the
///   fleet.
std::optional<Payload> open_payload(const RadioMessage& message, std::string_view planner, std::size_t fleet_size);

/// The payloads of all messages that open_payload() opens, in the order of the messages.
std::vector<Payload> open_payloads(std::span<const RadioMessage> messages, std::string_view planner,
                                   std::size_t fleet_size);

}  // namespace skein::agent
