// What other software has to do with a fleet here: variables, libraries, Docker, and what Fast DDS programs left
// behind. Only reads; asks Docker by its client.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace skein::doctor {

/// Shared memory of Fast DDS, which ROS 2 nodes use and a fleet does not.
struct SharedMemoryFacts {
  bool there = false, writable = false;  ///< /dev/shm
  std::uint64_t free = 0;                ///< [bytes]
  std::size_t segments = 0;              ///< files fastrtps_* and fast_datasharing_*
  std::size_t unused = 0;                ///< of these: no process that can be seen has them open
  std::uint64_t unused_bytes = 0;
};

struct VariableFacts {
  std::vector<std::string> ignored{};  ///< set, and not passed on to a fleet's programs
  std::vector<std::filesystem::path>
      vendor;  ///< libraries of DDS vendors that LD_LIBRARY_PATH put in the place of Debian's
};

struct DockerFacts {
  bool client = false;
  std::string host{};                    ///< DOCKER_HOST
  std::optional<std::string> engine{};   ///< its version, when it answers
  std::string trouble{};                 ///< what the client says otherwise
  std::optional<std::string> compose{};  ///< its version
};

/// @param root  for tests: where dev/shm and proc/ are.
SharedMemoryFacts read_shared_memory(const std::filesystem::path& root = "/");
VariableFacts read_variables();
/// Takes some seconds at most.
DockerFacts ask_docker();

}  // namespace skein::doctor
