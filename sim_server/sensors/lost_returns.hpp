// Draws which beams of a LiDAR return nothing. The draw does not depend on what the beams hit: each beam is lost
// independently with the probability `no_return_p`, and all beams in the columns of `dropped_sectors` are lost.
// Units: SI; degrees where a name says so.   Threads: one.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/scenario/scenario.hpp"

namespace skein::sim {

class LostReturns {
 public:
  /// @param uav   index in the fleet; part of the keys of the random streams.
  /// @param seed  0: no return is lost. Otherwise the stream (seed, "lidar_no_return", uav, scan number) has one draw
  ///              for each beam of the scan, whether or not the beam hits something. The stream (seed,
  ///              "lidar_dropped_sectors", uav, period number) draws the sectors for a period of `hold_s`.
  LostReturns(const LidarConfig& config, UavIndex uav, std::uint64_t seed);

  /// Whether any beam of any scan may lose its return.
  bool any() const { return seed_ != 0 && (config_.no_return_p > 0.0 || config_.dropped_sectors.has_value()); }

  /// Which beams of the scan at a tick lose their returns, ring by ring. The sectors at this tick apply to the whole
  /// scan, even if it takes longer than `hold_s`.
  /// @param tick  >= 0.   @returns a flag for each beam, valid until the next call.
  const std::vector<bool>& of(Tick tick);

 private:
  void draw_sectors(std::uint64_t hold);

  LidarConfig config_;
  UavIndex uav_;
  std::uint64_t seed_;
  std::optional<std::uint64_t> hold_;  ///< number of the period for which dropped_ was drawn
  std::vector<bool> dropped_;          ///< by column
  std::vector<bool> lost_;             ///< by beam
};

}  // namespace skein::sim
