#include "cli/bench/sizes.hpp"

#include <spdlog/fmt/fmt.h>

#include "core/scenario/scenario_reader.hpp"
#include "process/host/memory.hpp"

namespace skein::cli {

BenchSizes sizes_that_fit(const std::vector<std::size_t>& sizes, const std::optional<std::uint64_t>& left, bool dds) {
  BenchSizes fitting;
  for (const std::size_t uavs : sizes) {
    if (const std::string why = memory_shortage(one_process_memory(uavs), left); !why.empty()) {
      fitting.said.push_back(fmt::format("{} UAVs: not measured, because in one process the fleet {}", uavs, why));
      continue;
    }
    const std::string shortage = memory_shortage(fleet_memory(uavs), left);
    const std::string why_not = uavs > kMostUavsOverDds ? fmt::format("a fleet has at most {} UAVs", kMostUavsOverDds)
                                : shortage.empty()      ? ""
                                                        : "the fleet " + shortage;
    fitting.fleets.push_back({uavs, dds && why_not.empty()});
    if (!dds || why_not.empty()) continue;
    fitting.said.push_back(fmt::format("{} UAVs: measured in one process only, because over DDS {}", uavs, why_not));
  }
  return fitting;
}

}  // namespace skein::cli
