// Encodes messages as bytes and decodes them: XCDR1 (plain CDR) after the 4-byte encapsulation header of DDS.
// All functions are safe from any thread.
#pragma once

#include <fastcdr/Cdr.h>

#include <cstdint>
#include <span>
#include <vector>

#include "idl/type_names.hpp"

namespace skein {

namespace detail {

/// Writes the header, calls `body` with a stream that continues after it, and pads the result with zeros to a multiple
/// of four bytes. RTPS pads in the same way, so a payload has the same bytes in a program and on the wire.
/// @param body_size  number of bytes that `body` writes
std::vector<std::uint8_t> encode(std::size_t body_size, void (*body)(eprosima::fastcdr::Cdr&, const void*),
                                 const void* message);

/// Reads the header and calls `body`. @returns false when the header is not CDR_LE or CDR_BE, or `body` throws.
bool decode(std::span<const std::uint8_t> payload, void (*body)(eprosima::fastcdr::Cdr&, void*), void* message);

/// Size of the payload of a message that takes `body_size` bytes.
constexpr std::size_t payload_size(std::size_t body_size) {
  constexpr std::size_t kHeaderSize = 4;
  return (kHeaderSize + body_size + 3) / 4 * 4;
}

}  // namespace detail

/// Number of bytes that encode() would return.
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

/// Decodes a payload from the network, and trusts none of its contents. Never throws.
/// Allocates less than sizeof(an element) times the size of the payload, whatever lengths the payload claims.
/// @param payload CDR_LE or CDR_BE with encapsulation header; surplus bytes at the end are ignored.
/// @returns false when the payload is truncated or malformed; `message` is then unspecified, but valid.
template <class T>
bool decode(std::span<const std::uint8_t> payload, T& message) {
  return detail::decode(
      payload, [](eprosima::fastcdr::Cdr& stream, void* m) { static_cast<T*>(m)->deserialize(stream); }, &message);
}

}  // namespace skein
