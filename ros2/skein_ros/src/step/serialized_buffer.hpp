// A buffer of the rmw for one serialised message.   Threads: one.
#pragma once

#include <algorithm>
#include <cstdint>
#include <new>
#include <vector>

#include <rmw/error_handling.h>
#include <rmw/serialized_message.h>

namespace skein_ros {

class SerializedBuffer {
 public:
  /// @param bytes  capacity; the constructor sets these bytes to 0
  explicit SerializedBuffer(std::size_t bytes = 0) : buffer_(rmw_get_zero_initialized_serialized_message()) {
    const auto allocator = rcutils_get_default_allocator();
    if (rmw_serialized_message_init(&buffer_, bytes, &allocator) != RMW_RET_OK) throw std::bad_alloc();
    std::fill_n(buffer_.buffer, bytes, std::uint8_t{0});
  }
  ~SerializedBuffer() {
    if (rmw_serialized_message_fini(&buffer_) != RMW_RET_OK) rmw_reset_error();
  }
  SerializedBuffer(const SerializedBuffer&) = delete;
  SerializedBuffer& operator=(const SerializedBuffer&) = delete;

  rmw_serialized_message_t* get() { return &buffer_; }
  std::size_t capacity() const { return buffer_.buffer_capacity; }
  std::vector<std::uint8_t> bytes() const { return {buffer_.buffer, buffer_.buffer + buffer_.buffer_length}; }

 private:
  rmw_serialized_message_t buffer_;
};

}  // namespace skein_ros
