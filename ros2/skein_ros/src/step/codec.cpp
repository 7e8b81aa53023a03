#include "codec.hpp"

#include <rcutils/error_handling.h>
#include <rmw/error_handling.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "serialized_buffer.hpp"

#ifdef SKEIN_HAS_FASTCDR
#include <fastcdr/Cdr.h>
#include <fastcdr/exceptions/Exception.h>
#include <rosidl_typesupport_fastrtps_cpp/message_type_support.h>
#endif

namespace skein_ros {
namespace {

constexpr std::size_t kUsualBytes = 4096;

std::vector<std::uint8_t> encoded_by_rmw(const void* message, const rosidl_message_type_support_t* type) {
  // The middleware does not write CDR's padding. The digest covers the bytes of radio messages, so the padding must be
  // zero. A buffer that has grown may have other bytes there: serialise again, into a larger one.
  for (std::size_t capacity = kUsualBytes;;) {
    SerializedBuffer buffer(capacity);
    if (rmw_serialize(message, type, buffer.get()) != RMW_RET_OK) {
      const std::string why = rmw_get_error_string().str;
      rmw_reset_error();
      throw std::runtime_error("a message cannot be serialised: " + why);
    }
    if (buffer.capacity() <= capacity) return buffer.bytes();
    capacity = buffer.capacity();
  }
}

bool decoded_by_rmw(const std::vector<std::uint8_t>& bytes, const rosidl_message_type_support_t* type, void* message) {
  const rmw_serialized_message_t view = view_of(bytes);
  if (rmw_deserialize(&view, type, message) == RMW_RET_OK) return true;
  rmw_reset_error();
  return false;
}

#ifdef SKEIN_HAS_FASTCDR

using Callbacks = message_type_support_callbacks_t;
using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;

/// For messages in C++, and for those in C, which Python uses.
const void* callbacks_of(const rosidl_message_type_support_t* type) {
  for (const char* language : {"rosidl_typesupport_fastrtps_cpp", "rosidl_typesupport_fastrtps_c"}) {
    const auto* const found = get_message_typesupport_handle(type, language);
    if (found != nullptr) return found->data;
    rcutils_reset_error();
  }
  return nullptr;
}

std::vector<std::uint8_t> encoded(const void* message, const Callbacks& callbacks) {
  constexpr std::size_t kHeaderBytes = 4;
  std::vector<std::uint8_t> bytes(kHeaderBytes + callbacks.get_serialized_size(message), 0);
  FastBuffer buffer(reinterpret_cast<char*>(bytes.data()), bytes.size());
  Cdr stream(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
  try {
    stream.serialize_encapsulation();
    if (!callbacks.cdr_serialize(message, stream)) throw std::runtime_error("a message cannot be serialised");
  } catch (const eprosima::fastcdr::exception::Exception& error) {
    throw std::runtime_error("a message cannot be serialised: " + std::string(error.what()));
  }
  bytes.resize(stream.getSerializedDataLength());
  return bytes;
}

bool decoded(const std::vector<std::uint8_t>& bytes, const Callbacks& callbacks, void* message) {
  FastBuffer buffer(reinterpret_cast<char*>(const_cast<std::uint8_t*>(bytes.data())), bytes.size());
  Cdr stream(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
  try {
    stream.read_encapsulation();
    return callbacks.cdr_deserialize(stream, message);
  } catch (const eprosima::fastcdr::exception::Exception&) {
    return false;
  }
}

#else

const void* callbacks_of(const rosidl_message_type_support_t*) { return nullptr; }

#endif

}  // namespace

rmw_serialized_message_t view_of(const std::vector<std::uint8_t>& bytes) {
  rmw_serialized_message_t view = rmw_get_zero_initialized_serialized_message();
  view.buffer = const_cast<std::uint8_t*>(bytes.data());
  view.buffer_length = view.buffer_capacity = bytes.size();
  view.allocator = rcutils_get_default_allocator();
  return view;
}

Codec::Codec(const rosidl_message_type_support_t* type) : type_(type), callbacks_(callbacks_of(type)) {}

std::vector<std::uint8_t> Codec::encode(const void* message) const {
#ifdef SKEIN_HAS_FASTCDR
  if (callbacks_ != nullptr) return encoded(message, *static_cast<const Callbacks*>(callbacks_));
#endif
  return encoded_by_rmw(message, type_);
}

bool Codec::decode(const std::vector<std::uint8_t>& bytes, void* message) const {
#ifdef SKEIN_HAS_FASTCDR
  if (callbacks_ != nullptr) return decoded(bytes, *static_cast<const Callbacks*>(callbacks_), message);
#endif
  return decoded_by_rmw(bytes, type_, message);
}

}  // namespace skein_ros
