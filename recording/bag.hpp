// ROS 2's bag tools need more than the messages of a recording: the QoS with which each topic was offered (in the
// metadata of its channel), and a metadata.yaml, which makes a run's folder a bag (`ros2 bag play FOLDER`).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace skein::recording {

/// File name in the run's folder.
inline constexpr const char* kBagMetadata = "metadata.yaml";

/// The QoS of a recorded topic on the wire, in YAML, as rosbag2 of ROS 2 Humble writes it. Pure.
/// @param topic  its ROS name in the recording.
std::string offered_qos_profiles(std::string_view topic);

/// The metadata.yaml of a folder with this recording, in version 5, which rosbag2 reads from Humble on. Topics of
/// unknown type are left out, since no player could publish them.
/// @throws InputError if the recording cannot be read.
std::string bag_metadata(const std::filesystem::path& recording);

}  // namespace skein::recording
