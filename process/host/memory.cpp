#include "process/host/memory.hpp"

#include <spdlog/fmt/fmt.h>

#include <fstream>

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

std::string memory_shortage(std::uint64_t need, const std::optional<std::uint64_t>& left) {
  if (!left || need <= *left) return "";
  const auto megabytes = [](std::uint64_t bytes) { return 1e-6 * static_cast<double>(bytes); };
  return fmt::format("needs about {:.0f} MB of memory, and this host has {:.0f} MB left", megabytes(need),
                     megabytes(*left));
}

}  // namespace skein
