// What ROS 2's bag tools want to know of a recording beside its messages: the quality of service that each topic was
// offered with, in its channel, and a metadata.yaml, which makes a run's folder a bag (`ros2 bag play FOLDER`).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace skein::recording {

/// In the run's folder.
inline constexpr const char* kBagMetadata = "metadata.yaml";

/// The QoS of a recorded topic as rosbag2 of ROS 2 Humble writes it, in YAML: of the topic on the wire.
/// @param topic  its ROS name in the recording.
std::string offered_qos_profiles(std::string_view topic);

/// The metadata.yaml of a folder with this recording: version 5, which rosbag2 reads from Humble on. Topics whose type
/// nobody knows are left out, since no player could publish them.
/// @throws InputError when the recording cannot be read.
std::string bag_metadata(const std::filesystem::path& recording);

}  // namespace skein::recording
