// Converts messages to CDR and back. rmw_cyclonedds_cpp builds the description of a type anew at each rmw_serialize()
// and rmw_deserialize(), which took half of a node's time. So, with either middleware, the codec uses the type support
// of rmw_fastrtps_cpp if the message's package has it, as all packages built with the usual ROS 2 do.
// Threads: no shared state.
#pragma once

#include <rmw/rmw.h>

#include <cstdint>
#include <vector>

namespace skein_ros {

/// The bytes as a message of the rmw, not copied: the caller keeps them.
rmw_serialized_message_t view_of(const std::vector<std::uint8_t>& bytes);

/// For messages of one type.
class Codec {
 public:
  explicit Codec(const rosidl_message_type_support_t* type);

  /// With encapsulation header, and zeros where CDR has padding. @throws std::runtime_error if that fails
  std::vector<std::uint8_t> encode(const void* message) const;
  /// @returns false if the bytes are no such message
  bool decode(const std::vector<std::uint8_t>& bytes, void* message) const;

 private:
  const rosidl_message_type_support_t* const type_;
  const void* const callbacks_;  ///< message_type_support_callbacks_t of rmw_fastrtps_cpp; nullptr: there are none
};

}  // namespace skein_ros
