// Who knows what of a voxel grid: keeps the maps of all UAVs that hear each other the same, without
// acknowledgements. Everybody says now and then what it knows in form of a hash for each chunk; from that the others
// see which chunks somebody in line of sight lacks, and send these. What was lost on the way still differs and goes
// out again; what somebody else sent in the meantime does not.
// Threads: one.   Bounded: a message has one hash a chunk and at most `max_chunks` chunks.   Deterministic.
// Source: chunk-wise exchange as in RACER; hashes in place of its lists of intervals, because maps merge (voxel_grid).
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
    std::size_t max_chunks = 4;    ///< in one message
    std::size_t max_bytes = 4096;  ///< of chunks in one message; at least one goes out
    double forget_s = 10.0;        ///< an account of what somebody knows that is older does not count
  };

  MapExchange() : MapExchange(Config()) {}
  explicit MapExchange(const Config& config) : config_(config) {}

  /// Appends what is to be said now: all hashes, and chunks that somebody in line of sight lacks.
  void write(const VoxelGrid& grid, const Peers& peers, Tick now, PayloadWriter& writer);
  /// Takes in what write() wrote elsewhere: chunks into the grid, hashes as the sender's account.
  /// @returns false when the message is damaged or of another grid; what came before the damage was taken.
  bool read(std::size_t sender, Tick now, VoxelGrid& grid, PayloadReader& reader);

 private:
  struct Account {
    std::vector<std::uint16_t> hashes;
    Tick heard = 0;
  };

  const Config config_;
  std::map<std::size_t, Account> accounts_;  ///< by sender
  std::size_t next_chunk_ = 0;               ///< chunks take turns
};

}  // namespace skein::agent
