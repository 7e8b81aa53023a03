// Fleets of any size for `skein bench`: a scenario in YAML, nothing drawn at random.
#pragma once

#include <cstddef>
#include <string>

namespace skein::cli {

struct BenchFleet {
  std::size_t uavs = 5;
  double duration_s = 10.0;         ///< mission time
  double exchange_period_s = 0.05;  ///< 0.0025, one physics tick: the fleet does almost nothing but exchange messages
};

/// The procedural towers with a square of UAVs on the open ground beside them, 5 m apart; two of every five are
/// explorers, as in the benchmark's own fleet.
std::string bench_scenario(const BenchFleet& fleet);

}  // namespace skein::cli
