// Messages to CDR and back. rmw_cyclonedds_cpp builds its description of a type anew at each rmw_serialize() and
// rmw_deserialize(), which took half of a node's time; so where a message's package has the type support of
// rmw_fastrtps_cpp, as all have that were built with the usual ROS 2, that is used with either middleware.
// Threads: none of this is shared.
#pragma once

#include <rmw/rmw.h>

#include <cstdint>
#include <vector>

namespace skein_ros {

/// rmw's view of bytes, which stay the caller's.
rmw_serialized_message_t view_of(const std::vector<std::uint8_t>& bytes);

/// Of one type of messages.
class Codec {
 public:
  explicit Codec(const rosidl_message_type_support_t* type);

  /// With encapsulation header, and zeros where CDR has padding. @throws std::runtime_error when it cannot be written
  std::vector<std::uint8_t> encode(const void* message) const;
  /// @returns false for what is no such message
  bool decode(const std::vector<std::uint8_t>& bytes, void* message) const;

 private:
  const rosidl_message_type_support_t* const type_;
  const void* const callbacks_;  ///< message_type_support_callbacks_t of rmw_fastrtps_cpp; nullptr: there are none
};

}  // namespace skein_ros
