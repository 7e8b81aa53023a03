// Beams of a LiDAR that return nothing, whatever they meet: each beam for itself with `no_return_p`, and all beams of
// the columns of `dropped_sectors`.
// Units: SI, degrees where a name says so.   Threads: one.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/scenario.hpp"

namespace skein::sim {

class LostReturns {
 public:
  /// @param uav   fleet index: it keys the draws.
  /// @param seed  0: no return is lost. Otherwise they are drawn from streams keyed by (seed, "lidar_no_return", uav,
  ///              scan number), with a draw for each beam of the scan, whether or not it meets something, and by (seed,
  ///              "lidar_dropped_sectors", uav, hold number).
  LostReturns(const LidarConfig& config, UavIndex uav, std::uint64_t seed);

  /// Whether any beam of any scan may lose its return.
  bool any() const { return seed_ != 0 && (config_.no_return_p > 0.0 || config_.dropped_sectors.has_value()); }

  /// Which beams of the scan at a tick lose their returns, ring by ring. A scan that is longer than `hold_s` has the
  /// sectors of its tick.
  /// @param tick  >= 0.   @returns  good until the next call.
  const std::vector<bool>& of(Tick tick);

 private:
  void draw_sectors(std::uint64_t hold);

  LidarConfig config_;
  UavIndex uav_;
  std::uint64_t seed_;
  std::optional<std::uint64_t> hold_;  ///< of dropped_
  std::vector<bool> dropped_;          ///< by column
  std::vector<bool> lost_;             ///< by beam
};

}  // namespace skein::sim
