// Lists the segments of shared memory in /dev/shm, for example those of Fast DDS in ROS 2 nodes, and finds those that
// no process uses.
#pragma once

#include <filesystem>
#include <set>
#include <string>

namespace skein::test {

inline const std::filesystem::path kSharedMemory = "/dev/shm";

/// The names of the files in `folder`.
std::set<std::string> shared_memory(const std::filesystem::path& folder = kSharedMemory);

/// Returns those of `names` that no process has open or mapped: their creator has ended without removing them, or is
/// about to remove them. Segments that only other users' processes use count as unused.
/// @param folder  absolute path without symbolic links.
std::set<std::string> unused_shared_memory(std::set<std::string> names,
                                           const std::filesystem::path& folder = kSharedMemory);

}  // namespace skein::test
