// Keeps the ledger: which captures were really taken, and who collided. Append-only, in the order of time.
// A capture enters with a random token, so that nobody can claim what no camera saw (see DESIGN section "custody").
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/scoring/score_table.hpp"
#include "sight/camera.hpp"

namespace skein::sim {

/// Not thread-safe.
class Referee {
 public:
  /// @param seed  tokens are drawn from streams keyed by (seed, "custody", uav, capture).
  Referee(std::uint64_t seed, std::size_t uavs, std::size_t points, const RulesConfig& rules);

  /// Enters a capture if it raised at least one point for that UAV; only such points enter.
  /// @returns the report for the UAV (the ledger holds the same), or nullopt: nothing raised, or the UAV has collided.
  /// @throws std::logic_error when `capture.tick` is earlier than the last entry's.
  std::optional<CaptureReport> enter(UavIndex uav, const Capture& capture);

  /// Enters a UAV's collision; only its first counts. @returns whether it was the first.
  /// @throws std::logic_error when `tick` is earlier than the last entry's.
  bool enter_collision(UavIndex uav, Tick tick);

  const std::vector<LedgerEntry>& ledger() const { return ledger_; }
  /// All reports of one UAV, oldest first: what its camera's card holds.
  std::vector<CaptureReport> reports(UavIndex uav) const;
  /// The score as if every capture were delivered.
  const ScoreTable& earned() const { return earned_; }

 private:
  LedgerEntry& append(UavIndex uav, Tick tick);

  std::uint64_t seed_;
  std::vector<LedgerEntry> ledger_;
  std::vector<std::uint64_t> next_capture_;  ///< by UAV
  std::vector<bool> collided_;               ///< by UAV
  ScoreTable earned_;
};

}  // namespace skein::sim
