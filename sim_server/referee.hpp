// Keeps the ledger of the captures that were really taken, and of the UAVs that collided. Append-only, in the order of
// time. Each capture gets a random token, and reports without it do not count, so that no program can claim what no
// camera saw (docs/architecture.md, "Custody of the score").
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

  /// Enters a capture if it improved this UAV's best quality of at least one interest point, with these points only.
  /// @returns the report for the UAV, as the ledger has it; nullopt: no point improved, or the UAV has collided.
  /// @throws std::logic_error when `capture.tick` is earlier than the last entry's.
  std::optional<CaptureReport> enter(UavIndex uav, const Capture& capture);

  /// Enters a UAV's collision; only its first counts. @returns whether it was the first.
  /// @throws std::logic_error when `tick` is earlier than the last entry's.
  bool enter_collision(UavIndex uav, Tick tick);

  /// Notes the points that a capture shows too poorly to count, and those for which it counts. Only reports depend on
  /// this.
  void note_poor(const Capture& capture);
  const PoorPictures& poor_pictures() const { return poor_; }

  const std::vector<LedgerEntry>& ledger() const { return ledger_; }
  /// The reports of all captures of one UAV in the ledger, oldest first.
  std::vector<CaptureReport> reports(UavIndex uav) const;
  /// The score if every capture were delivered.
  const ScoreTable& earned() const { return earned_; }

 private:
  LedgerEntry& append(UavIndex uav, Tick tick);

  std::uint64_t seed_;
  std::vector<LedgerEntry> ledger_;
  std::vector<std::uint64_t> next_capture_;  ///< by UAV
  std::vector<bool> collided_;               ///< by UAV
  ScoreTable earned_;
  PoorPictures poor_;
};

}  // namespace skein::sim
