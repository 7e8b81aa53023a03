#include "idl/cdr.hpp"

#include <exception>

namespace skein::detail {

using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;

namespace {
constexpr std::size_t kHeaderSize = 4;
}

std::vector<std::uint8_t> encode(std::size_t body_size, void (*body)(Cdr&, const void*), const void* message) {
  std::vector<std::uint8_t> payload(payload_size(body_size));
  FastBuffer buffer(reinterpret_cast<char*>(payload.data()), payload.size());
  Cdr stream(buffer, Cdr::LITTLE_ENDIANNESS, Cdr::DDS_CDR);
  stream.serialize_encapsulation();
  body(stream, message);
  return payload;
}

bool decode(std::span<const std::uint8_t> payload, void (*body)(Cdr&, void*), void* message) {
  // 0x0000 is CDR_BE, 0x0001 CDR_LE. Skein's types use neither parameter lists nor XCDR2.
  if (payload.size() < kHeaderSize || payload[0] != 0 || payload[1] > 1) return false;
  try {
    // Fast-CDR takes a mutable buffer for reading too, but does not write to it.
    FastBuffer buffer(const_cast<char*>(reinterpret_cast<const char*>(payload.data())), payload.size());
    Cdr stream(buffer, Cdr::LITTLE_ENDIANNESS, Cdr::DDS_CDR);
    stream.read_encapsulation();
    body(stream, message);
    return true;
  } catch (const std::exception&) {
    return false;  // truncated, a bool that is neither 0 nor 1, a string without its end, or out of memory
  }
}

}  // namespace skein::detail
