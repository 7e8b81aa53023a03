// Messages to bytes and back: XCDR1 (plain CDR) with the 4-byte encapsulation header that DDS puts in front.
// All functions may be called from any thread.
#pragma once

#include <fastcdr/Cdr.h>

#include <cstdint>
#include <span>
#include <vector>

#include "idl/type_names.hpp"

namespace skein {

namespace detail {

/// Writes the header and calls `body` with a stream behind it; the result is padded with zeros to a multiple of four
/// bytes, as RTPS pads it on the wire: so a payload is the same bytes wherever one looks at it.
/// @param body_size bytes that `body` writes
std::vector<std::uint8_t> encode(std::size_t body_size, void (*body)(eprosima::fastcdr::Cdr&, const void*),
                                 const void* message);

/// Reads the header and calls `body`; false when either is not as it should be.
bool decode(std::span<const std::uint8_t> payload, void (*body)(eprosima::fastcdr::Cdr&, void*), void* message);

/// Of a payload whose message takes `body_size` bytes.
constexpr std::size_t payload_size(std::size_t body_size) {
  constexpr std::size_t kHeaderSize = 4;
  return (kHeaderSize + body_size + 3) / 4 * 4;
}

}  // namespace detail

/// Bytes that encode() would return.
template <class T>
std::size_t encoded_size(const T& message) {
  return detail::payload_size(T::getCdrSerializedSize(message));
}

/// @returns the payload: encapsulation header CDR_LE, then the message, padded with zeros to a multiple of 4 bytes.
template <class T>
std::vector<std::uint8_t> encode(const T& message) {
  return detail::encode(
      T::getCdrSerializedSize(message),
      [](eprosima::fastcdr::Cdr& stream, const void* m) { static_cast<const T*>(m)->serialize(stream); }, &message);
}

/// Reads what came from the network: nothing about it is trusted. Never throws.
/// The memory asked for stays below sizeof(an element) times the size of the payload, whatever lengths it claims.
/// @param payload CDR_LE or CDR_BE with encapsulation header; surplus bytes at the end are ignored.
/// @returns false when the payload is truncated or malformed; `message` is then unspecified, but valid.
template <class T>
bool decode(std::span<const std::uint8_t> payload, T& message) {
  return detail::decode(
      payload, [](eprosima::fastcdr::Cdr& stream, void* m) { static_cast<T*>(m)->deserialize(stream); }, &message);
}

}  // namespace skein
