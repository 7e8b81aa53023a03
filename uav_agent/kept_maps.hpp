// The map that a UAV flies on, in time: every so often a snapshot of it in a file of its own, maps-<uav>.mcap in the
// run's folder (docs/results.md). Times are simulated: the same run makes the same file. A program that was killed and
// started again writes one more part.
// Each snapshot is in the file when keep() returns. A disk that refuses ends the file, never the run.
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
  /// Opens nothing yet. @param folder  the run's. @param period  at least 1.
  KeptMaps(std::filesystem::path folder, std::string uav, Tick period);

  /// After each step: a snapshot where one is due and the map has changed since the last.
  /// @param world  nullptr: it flies on the map of key frames. The same kind at each call.
  void keep(Tick tick, const WorldMap* world, const OccupancyMap& key_frames);
  /// Once, when nothing more will follow: one of the end, changed or not, if there was any step at all.
  void end(const WorldMap* world, const OccupancyMap& key_frames);
  /// What went wrong, for people; empty as long as nothing did.
  const std::string& trouble() const { return trouble_; }

 private:
  bool has_changed(const WorldMap* world, const OccupancyMap& key_frames);
  void write(const WorldMap* world, const OccupancyMap& key_frames);
  void open();

  const std::filesystem::path folder_;
  const std::string uav_;
  const Tick period_;
  Tick due_ = 0;
  std::optional<Tick> tick_, written_;  ///< of the last step, and of the last snapshot
  MapTree tree_;                        ///< of a WorldMap, as of the last snapshot
  std::uint64_t key_frames_ = 0;        ///< else: how many the last snapshot had
  std::optional<mcap::Writer> file_;
  std::uint16_t channel_ = 0;
  std::string trouble_;
};

}  // namespace skein::agent
