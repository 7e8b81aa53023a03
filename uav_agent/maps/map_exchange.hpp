// Exchange of voxel grids by radio: UAVs that hear each other come to equal grids, without acknowledgements. Each UAV
// sends from time to time a hash of each chunk of its grid. From these hashes the others see which chunks differ at a
// UAV in line of sight, and send them. A chunk that was lost on the way still differs, so it is sent again. A chunk
// that a third UAV has sent in the meantime no longer differs, so it is not sent again.
// Threads: one.   Deterministic.
// Bounded: a message has one hash per chunk (at most VoxelGrid::kMostChunks) and at most `max_chunks` chunks.
// Source: chunk-wise exchange as in RACER; hashes replace its lists of intervals, since grids merge (voxel_grid.hpp).
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "uav_agent/api/peers.hpp"
#include "uav_agent/maps/voxel_grid.hpp"

namespace skein::agent {

class MapExchange {
 public:
  struct Config {
    std::size_t max_chunks = 4;    ///< in one message; chosen
    std::size_t max_bytes = 4096;  ///< of chunks in one message; the first chunk may exceed it; chosen
    double forget_s = 10.0;        ///< a peer's hashes that are older than this are ignored; chosen
  };

  MapExchange() : MapExchange(Config()) {}
  explicit MapExchange(const Config& config) : config_(config) {}

  /// Appends a message: the hashes of all chunks, and chunks that differ at a UAV in line of sight.
  void write(const VoxelGrid& grid, const Peers& peers, Tick now, PayloadWriter& writer);
  /// Reads a message of another UAV's write(): merges its chunks into the grid, and remembers its hashes.
  /// @returns false if the message is damaged or of another grid; the parts before the damage have taken effect.
  bool read(std::size_t sender, Tick now, VoxelGrid& grid, PayloadReader& reader);

 private:
  struct Account {                      ///< what a peer knows
    std::vector<std::uint16_t> hashes;  ///< by chunk
    Tick heard = 0;
  };

  const Config config_;
  std::map<std::size_t, Account> accounts_;  ///< by sender
  std::size_t next_chunk_ = 0;               ///< where the search for the next chunk begins: chunks take turns
};

}  // namespace skein::agent
