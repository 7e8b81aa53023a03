// `skein bench --tracking`: the distances of the bundled vehicles from their setpoints, and a bound on this distance
// that depends on speed and acceleration of the setpoint. docs/flight-safety.md has the table.
#pragma once

#include <filesystem>
#include <ostream>
#include <string>

#include "cli/bench/bench_options.hpp"
#include "cli/console.hpp"
#include "results/tracking_table.hpp"

namespace skein::cli {

/// |error| <= c0 + c1 |v| + c2 |a|, with v and a of the setpoint [m, m/s, m/s^2].
struct TrackingBound {
  double c0_m = 0.0, c1_s = 0.0, c2_s2 = 0.0;
  double covered = 0.0;   ///< share of all samples for which the bound holds
  double mean_m = 0.0;    ///< mean of the bound over the samples
  double beyond_m = 0.0;  ///< greatest excess of a sample over the bound

  double at(double speed_mps, double acceleration_mps2) const {
    return c0_m + c1_s * speed_mps + c2_s2 * acceleration_mps2;
  }
};

/// The bound with the smallest mean among those that hold for `share` of a vehicle's samples. Each sample counts with
/// the least speed and acceleration, and the greatest error, of its bin.
/// @param share  in (0, 1].
TrackingBound fit_bound(const results::TrackingTable& table, const std::string& vehicle, double share);

/// Prints quantiles of the distance by speed and acceleration, and the bounds, for each vehicle.
void print_tracking(std::ostream& out, const results::TrackingTable& table);

/// Flies `patrol`, `kios`, `xxh` and `star` in the five procedural scenarios (with --quick: in `towers` only), without
/// faults; with --assets in `mbs` and `crane`, too. Writes to runs/bench-tracking, and does not repeat flights that
/// these programs have already flown. Takes about ten minutes, with --quick one. @returns as bench_planners().
int bench_tracking(const BenchOptions& options, const Console& console);

}  // namespace skein::cli
