// Other software on this machine that can affect a fleet: environment variables, libraries, Docker, and files that Fast
// DDS programs have left behind. Only reads; queries Docker with its client program.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace skein::doctor {

/// Shared memory of Fast DDS. ROS 2 nodes use it, a fleet does not.
struct SharedMemoryFacts {
  bool there = false, writable = false;  ///< /dev/shm
  std::uint64_t free = 0;                ///< [bytes]
  std::size_t segments = 0;              ///< files fastrtps_*, sem.fastrtps_*, fast_datasharing_*
  std::size_t unused = 0;                ///< of these: not in use by any visible process
  std::uint64_t unused_bytes = 0;
};

struct VariableFacts {
  std::vector<std::string> ignored{};         ///< set, but not passed on to a fleet's programs
  std::vector<std::filesystem::path> vendor;  ///< loaded DDS libraries from folders in LD_LIBRARY_PATH
};

struct DockerFacts {
  bool client = false;                   ///< whether the client program is installed
  std::string host{};                    ///< DOCKER_HOST
  std::optional<std::string> engine{};   ///< version of the engine; nullopt: no answer
  std::string trouble{};                 ///< the client's error message without an answer
  std::optional<std::string> compose{};  ///< command and version of Compose; nullopt: none
};

/// @param root  folder that contains dev/shm and proc/; for tests.
SharedMemoryFacts read_shared_memory(const std::filesystem::path& root = "/");
VariableFacts read_variables();
/// Blocks for up to 5 s per query if the engine hangs.
DockerFacts ask_docker();

}  // namespace skein::doctor
