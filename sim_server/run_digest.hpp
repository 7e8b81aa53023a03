// The digest of a run: SHA-256 over its states, captures, deliveries and tally changes, exchange by exchange,
// little-endian. Equal digests mean equal runs; a short hash of each field tells where two runs part (`skein diff`).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/scoring/score_table.hpp"
#include "core/text/sha256.hpp"
#include "core/types.hpp"

namespace skein::sim {

/// One exchange as the digest sees it.
struct DigestInput {
  struct Uav {
    RigidBodyState state;
    GimbalState gimbal;
    bool alive = true;
  };
  std::uint64_t k = 0;
  std::vector<Uav> uavs;                ///< in fleet order
  std::span<const LedgerEntry> ledger;  ///< new entries, in the ledger's order
  std::span<const std::uint8_t> radio;  ///< the router's digest of this step's deliveries; empty if there were none
  std::span<const std::uint8_t> tally;  ///< the station's digest of this step's changes; empty if there were none
};

/// One line of digests.csv. Each field has 8 hexadecimal digits: its 64-bit FNV-1a hash, folded to 32 bits.
struct StepDigest {
  std::uint64_t k = 0;
  std::string running;              ///< SHA-256 of all steps so far, 64 hexadecimal digits
  std::vector<std::string> fields;  ///< as RunDigest::columns() names them
};

/// Not thread-safe.
class RunDigest {
 public:
  /// @param uav_names  in fleet order.
  explicit RunDigest(std::span<const std::string> uav_names);

  /// Column names: "<uav>.position", "<uav>.attitude", ".velocity", ".body_rates", ".gimbal", ".alive" for each UAV,
  /// then "ledger", "radio", "tally".
  const std::vector<std::string>& columns() const { return columns_; }
  /// Hashes one exchange. Call it in the order of k. @throws std::logic_error when the fleet has another size.
  StepDigest add(const DigestInput& input);
  /// 64 hexadecimal digits over all exchanges so far; more may follow.
  std::string hex() const;

 private:
  std::vector<std::string> columns_;
  Sha256 running_;
};

}  // namespace skein::sim
