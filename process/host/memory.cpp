#include "process/host/memory.hpp"

#include <fstream>
#include <string>

namespace skein {

std::optional<std::uint64_t> memory_left() {
  constexpr std::uint64_t kBytesPerKb = 1024;
  std::ifstream in("/proc/meminfo");
  std::optional<std::uint64_t> available;
  std::uint64_t swap = 0;
  std::string key, unit;
  for (std::uint64_t kb = 0; in >> key >> kb && std::getline(in, unit);) {
    if (key == "MemAvailable:") available = kBytesPerKb * kb;
    if (key == "SwapFree:") swap = kBytesPerKb * kb;
  }
  return available ? std::optional(*available + swap) : std::nullopt;
}

}  // namespace skein
