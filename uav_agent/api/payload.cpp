#include "uav_agent/api/payload.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/radio/radio_routes.hpp"
#include "uav_agent/api/fnv_hash.hpp"

namespace skein::agent {
namespace {

constexpr double kPositionStepM = 0.01;  ///< format: positions are whole centimetres

// Format: a text must not contain NUL, so each byte 0 or 1 is written as the byte 1 and a second one.
constexpr char kEscape = 1, kEscapedZero = 1, kEscapedOne = 2;

/// Format: the sender and the check sum, before the content.
constexpr std::size_t kEnvelopeBytes = 2 * sizeof(std::uint16_t);

/// FNV-1a hash, folded to 16 bits: detects damaged payloads.
std::uint16_t check_sum(std::span<const std::uint8_t> bytes) {
  FnvHash hash;
  for (const std::uint8_t byte : bytes) hash.add(byte);
  return hash.folded();
}

std::string escaped(std::span<const std::uint8_t> bytes) {
  std::string text;
  text.reserve(bytes.size() + bytes.size() / 16);  // memory: a guess at the number of escapes
  for (const std::uint8_t byte : bytes) {
    if (byte > 1) {
      text.push_back(static_cast<char>(byte));
    } else {
      text.push_back(kEscape);
      text.push_back(byte == 0 ? kEscapedZero : kEscapedOne);
    }
  }
  return text;
}

std::optional<std::vector<std::uint8_t>> unescaped(std::string_view text) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != kEscape) {
      bytes.push_back(static_cast<std::uint8_t>(text[i]));
      continue;
    }
    if (++i == text.size() || (text[i] != kEscapedZero && text[i] != kEscapedOne)) return std::nullopt;
    bytes.push_back(text[i] == kEscapedZero ? 0 : 1);
  }
  return bytes;
}

}  // namespace

PayloadWriter& PayloadWriter::number(std::uint32_t value, int width) {
  for (int i = 0; i < width; ++i) bytes_.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  return *this;
}

PayloadWriter& PayloadWriter::position(const Vector3d& p_W) {
  for (int i = 0; i < 3; ++i) {
    u32(static_cast<std::uint32_t>(static_cast<std::int32_t>(std::lround(p_W[i] / kPositionStepM))));
  }
  return *this;
}

PayloadWriter& PayloadWriter::bytes(std::span<const std::uint8_t> bytes) {
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  return *this;
}

std::uint32_t PayloadReader::number(int width) {
  std::uint32_t value = 0;
  const auto taken = bytes(static_cast<std::size_t>(width));
  for (std::size_t i = 0; i < taken.size(); ++i) value |= std::uint32_t{taken[i]} << (8 * i);
  return value;
}

Vector3d PayloadReader::position() {
  Vector3d p;
  for (int i = 0; i < 3; ++i) p[i] = kPositionStepM * static_cast<std::int32_t>(u32());
  return p;
}

std::span<const std::uint8_t> PayloadReader::bytes(std::size_t count) {
  if (count > bytes_.size()) {
    ok_ = false;
    bytes_ = {};
    return {};
  }
  const auto taken = bytes_.first(count);
  bytes_ = bytes_.subspan(count);
  return taken;
}

std::size_t text_bytes(std::span<const std::uint8_t> bytes) {
  const auto escapes = std::ranges::count_if(bytes, [](std::uint8_t byte) { return byte <= 1; });
  return bytes.size() + static_cast<std::size_t>(escapes);
}

RadioMessage send_payload(std::string_view planner, std::size_t sender, const PayloadWriter& payload) {
  if (payload.size() > kMaxPayloadBytes) throw std::logic_error("a radio payload is too long");
  PayloadWriter envelope;
  envelope.u16(static_cast<std::uint16_t>(sender));
  envelope.u16(check_sum(payload.data()));
  envelope.bytes(payload.data());
  return {std::string(kPlanTopic), std::string(planner) + " " + escaped(envelope.data()), std::nullopt};
}

std::optional<Payload> open_payload(const RadioMessage& message, std::string_view planner, std::size_t fleet_size) {
  std::string_view text = message.text;
  if (message.topic != kPlanTopic || !text.starts_with(planner)) return std::nullopt;
  text.remove_prefix(planner.size());
  if (!text.starts_with(' ')) return std::nullopt;
  text.remove_prefix(1);
  const auto bytes = unescaped(text);
  if (!bytes || bytes->size() > kMaxPayloadBytes + kEnvelopeBytes) return std::nullopt;
  PayloadReader reader(*bytes);
  const std::size_t sender = reader.u16();
  const std::uint16_t sum = reader.u16();
  const auto content = reader.bytes(reader.left());
  if (!reader.ok() || sender >= fleet_size || sum != check_sum(content)) return std::nullopt;
  return Payload{sender, {content.begin(), content.end()}};
}

std::vector<Payload> open_payloads(std::span<const RadioMessage> messages, std::string_view planner,
                                   std::size_t fleet_size) {
  std::vector<Payload> payloads;
  for (const RadioMessage& message : messages) {
    if (auto payload = open_payload(message, planner, fleet_size)) payloads.push_back(std::move(*payload));
  }
  return payloads;
}

}  // namespace skein::agent
