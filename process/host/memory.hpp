// The memory of this host, and how much of it a fleet needs.   Threads: any.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace skein {

/// Memory that programs can still get on this host, swap included [bytes]; nullopt: the system does not tell. Ignores
/// limits of cgroups.
std::optional<std::uint64_t> memory_left();

/// Memory that a fleet's programs need over DDS [bytes]: an estimate, rounded up, from fleets of 1 to 100 UAVs
/// (docs/performance.md). Maps grow with the mission and the scene, so long missions need more.
constexpr std::uint64_t fleet_memory(std::size_t uavs) { return (90 + 9 * uavs) * 1'000'000; }
/// Memory that a fleet in one process needs [bytes]: an estimate from flights of 20 s with 1 to 1,000 UAVs. The term
/// with the square is for data about each pair of UAVs.
constexpr std::uint64_t one_process_memory(std::size_t uavs) {
  return (55 + 8 * uavs) * 1'000'000 + 7'000 * uavs * uavs;
}

/// Why a fleet that needs so much memory does not fit, as the end of a sentence about the fleet: "needs about 990 MB
/// of memory, and this host has 500 MB left". Empty if it fits, or if `left` is unknown.
/// @param need, left  [bytes].
std::string memory_shortage(std::uint64_t need, const std::optional<std::uint64_t>& left);

}  // namespace skein
