// Snapshots of the map that a UAV flies on, at regular simulated times, in the file maps-<uav>.mcap in the run's folder
// (docs/results.md). Equal runs write equal files. A restarted program writes another file, with the next number.
// Each snapshot is in the file when keep() returns. A disk error ends the file, but not the run.
// Frame W.   Threads: one.   Deterministic.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/types.hpp"
#include "recording/mcap/writer.hpp"
#include "uav_agent/maps/map_tree.hpp"
#include "uav_agent/maps/occupancy_map.hpp"

namespace skein::agent {

class KeptMaps {
 public:
  /// Opens no file yet. @param folder  of the run. @param period  between snapshots, at least 1.
  KeptMaps(std::filesystem::path folder, std::string uav, Tick period);

  /// Writes a snapshot if one is due and the map has changed since the last. Call it after each step.
  /// @param world  the map that the UAV flies on; nullptr at each call: it flies on `key_frames`.
  void keep(Tick tick, const WorldMap* world, const OccupancyMap& key_frames);
  /// Writes a last snapshot, even of an unchanged map, if there was any step, and closes the file. Call it once.
  void end(const WorldMap* world, const OccupancyMap& key_frames);
  /// Error message for the user; empty: no error.
  const std::string& write_error() const { return write_error_; }

 private:
  bool has_changed(const WorldMap* world, const OccupancyMap& key_frames);
  void write(const WorldMap* world, const OccupancyMap& key_frames);
  void open();

  const std::filesystem::path folder_;
  const std::string uav_;
  const Tick period_;
  Tick due_ = 0;
  std::optional<Tick> tick_, written_;  ///< tick of the last step, and of the last snapshot
  MapTree tree_;                        ///< the world map, at the last look
  std::uint64_t key_frames_ = 0;        ///< without a world map: number of key frames at the last look
  std::optional<mcap::Writer> file_;
  std::uint16_t channel_ = 0;
  std::string write_error_;
};

}  // namespace skein::agent
