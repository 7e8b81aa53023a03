// What lies in /dev/shm, and who uses it. Fast DDS of other programs (ROS 2 nodes) puts its segments there.
#pragma once

#include <filesystem>
#include <set>
#include <string>

namespace skein::test {

inline const std::filesystem::path kSharedMemory = "/dev/shm";

/// The names in `folder`.
std::set<std::string> shared_memory(const std::filesystem::path& folder = kSharedMemory);

/// Those of `names` that no process has open or mapped: whoever created them has ended without removing them, or is
/// about to remove them. Processes of other users count as if they used none. @param folder  absolute, without links
std::set<std::string> unused_shared_memory(std::set<std::string> names,
                                           const std::filesystem::path& folder = kSharedMemory);

}  // namespace skein::test
