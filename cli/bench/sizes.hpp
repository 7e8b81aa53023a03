// The fleet sizes that `skein bench` measures on this host: limited by DDS domains and by memory. Pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace skein::cli {

struct BenchSize {
  std::size_t uavs = 0;
  bool over_dds = false;  ///< measured over DDS, too; otherwise in one process only
};

struct BenchSizes {
  std::vector<BenchSize> fleets;  ///< in the order in which they were asked for
  std::vector<std::string> said;  ///< a line for each size that is not measured, or not over DDS, with the reason
};

/// @param left  memory that programs can still get on this host [bytes]; nullopt: unknown, then all sizes fit.
/// @param dds  whether fleets are to be measured over DDS, besides in one process.
BenchSizes sizes_that_fit(const std::vector<std::size_t>& sizes, const std::optional<std::uint64_t>& left, bool dds);

}  // namespace skein::cli
