#include "cli/bench/sizes.hpp"

#include <spdlog/fmt/fmt.h>

#include "core/scenario/scenario_reader.hpp"
#include "process/host/memory.hpp"

namespace skein::cli {
namespace {

/// Why a fleet that needs so much memory does not fit; empty: it does.
std::string too_large(std::uint64_t need, const std::optional<std::uint64_t>& left) {
  if (!left || need <= *left) return "";
  const auto megabytes = [](std::uint64_t bytes) { return 1e-6 * static_cast<double>(bytes); };
  return fmt::format("the fleet needs about {:.0f} MB of memory, and this host has {:.0f} MB left", megabytes(need),
                     megabytes(*left));
}

}  // namespace

BenchSizes sizes_that_fit(const std::vector<std::size_t>& sizes, const std::optional<std::uint64_t>& left, bool dds) {
  BenchSizes fitting;
  for (const std::size_t uavs : sizes) {
    if (const std::string why = too_large(one_process_memory(uavs), left); !why.empty()) {
      fitting.said.push_back(fmt::format("{} UAVs: not measured, because in one process {}", uavs, why));
      continue;
    }
    const std::string why_not = uavs > kMostUavsOverDds ? fmt::format("a fleet has at most {} UAVs", kMostUavsOverDds)
                                                        : too_large(fleet_memory(uavs), left);
    fitting.fleets.push_back({uavs, dds && why_not.empty()});
    if (!dds || why_not.empty()) continue;
    fitting.said.push_back(fmt::format("{} UAVs: measured in one process only, because over DDS {}", uavs, why_not));
  }
  return fitting;
}

}  // namespace skein::cli
