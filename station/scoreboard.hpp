// The station's tally: which captures were delivered, and what they are worth. Only a report that equals an entry of
// the referee's ledger counts, and only from the UAV that took it. An entry *stands* once the `ledger_upto` of
// a step includes it; only then are reports compared with it. Pure; the result of a step does not depend on the
// order in which its reports and entries came in. Not thread-safe.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "core/scoring/score_table.hpp"
#include "core/types.hpp"

namespace skein::station {

/// The reason why a report does not count.
enum class Refusal {
  unknown,   ///< no camera took such a capture: no entry has its token
  borrowed,  ///< it came from another UAV than the one that took the capture
  altered,   ///< taken by this UAV, but with another content
};
inline constexpr std::size_t kRefusals = 3;
std::string_view to_string(Refusal reason);

/// Something that changed the tally, as the journal keeps it: a report that was accepted, or a collision.
struct TallyRecord {
  Tick tick = 0;      ///< of the step in which the station took it in
  LedgerEntry entry;  ///< the entry that the report equals, or the collision's
  bool operator==(const TallyRecord&) const = default;
};

/// The result of one step.
struct StepOutcome {
  std::vector<TallyRecord> records;              ///< to be journalled before anything is acknowledged
  std::vector<std::vector<std::uint64_t>> acks;  ///< by UAV: captures to acknowledge, ascending
  /// SHA-256 over the points whose tally changed, by index; empty if none did: of each index, UAV, capture, bits of q
  /// (UAV, capture and q are 0 for a point that no delivered capture has any more); 8 bytes each.
  std::vector<std::uint8_t> digest;
  bool score_changed = false;
};

/// Whether an entry of the ledger was delivered, and whether a report of it was refused.
struct Audit {
  std::optional<Tick> delivered;   ///< when the station took it in
  std::optional<Refusal> refused;  ///< why a report of it was refused last, if ever
};

/// The tally from `tick` on.
struct TimelinePoint {
  Tick tick = 0;
  std::size_t points = 0;
  double score = 0.0;
  bool operator==(const TimelinePoint&) const = default;
};

class Scoreboard {
 public:
  /// @param uavs, points  size of the fleet and number of interest points.
  Scoreboard(std::size_t uavs, std::size_t points, const RulesConfig& rules);

  /// An entry of the ledger, in any order, repetitions allowed (a restarted station gets the whole ledger again).
  /// @throws std::invalid_argument when it differs from the entry of ledger() with its index, or names no UAV or point.
  void add_entry(const LedgerEntry& entry);
  /// Whether all entries 0 .. upto - 1 have arrived: then a step with this `ledger_upto` may be ended.
  bool has_entries(std::uint64_t upto) const { return ledger_.size() >= upto; }

  /// A report that arrived by radio from `source` (fleet index). report.uav >= fleet size: no UAV has the name in it.
  void add_report(std::size_t source, CaptureReport report);

  /// Ends the step at `tick`: entries 0 .. upto - 1 stand from now on, and reports are compared with them. A report
  /// whose entry is known but does not stand yet waits until it does; one without an entry waits for kPatience steps,
  /// then it is refused.
  /// @throws std::logic_error unless has_entries(upto).
  StepOutcome end_step(Tick tick, std::uint64_t upto);
  static constexpr int kPatience = 2;

  /// Restores a record of the journal, before the first step; no StepOutcome will contain it again.
  /// @throws std::invalid_argument when the record names no UAV or point of this run.
  void restore(const TallyRecord& record);

  const ScoreTable& delivered() const { return delivered_; }
  const ScoreTable& earned() const { return earned_; }  ///< as if every standing capture were delivered
  std::uint64_t standing() const { return standing_; }  ///< entries of the ledger that stand
  std::uint64_t reports_received() const { return received_; }
  std::uint64_t duplicates() const { return duplicates_; }
  std::uint64_t refused(Refusal reason) const { return refused_[static_cast<std::size_t>(reason)]; }
  /// Begins with {0, 0, 0}; one more for each step that changed the tally.
  const std::vector<TimelinePoint>& timeline() const { return timeline_; }
  /// Points of this UAV do not count: it collided, and the rules void its score.
  bool is_void(UavIndex uav) const { return collision_voids_ && collided_[uav]; }
  /// The ledger as far as it is known without gaps.
  const std::vector<LedgerEntry>& ledger() const { return ledger_; }
  Audit audit(const LedgerEntry& entry) const;

 private:
  using Key = std::pair<std::size_t, std::uint64_t>;   ///< UAV, capture
  using Before = std::map<std::uint32_t, PointTally>;  ///< points that a step may change, before it
  struct Held {
    std::size_t source;
    CaptureReport report;
    int steps = 0;  ///< number of steps that it has waited
  };
  struct Verdict {
    enum class Kind { accepted, duplicate, refused, wait } kind;
    Refusal reason = Refusal::unknown;
    const LedgerEntry* entry = nullptr;  ///< with the report's token, if any
  };

  void check(const LedgerEntry& entry) const;
  void enter(const LedgerEntry& entry);
  Verdict judge(const Held& held) const;
  void stand(std::uint64_t upto, Tick tick, StepOutcome& outcome, Before& before);
  void settle(Tick tick, StepOutcome& outcome, Before& before);
  /// Applies a record to the delivered tally. @param before  gets the points that it may change.
  void apply(const TallyRecord& record, Before& before);
  void extend_timeline(Tick tick);

  std::size_t points_;
  bool collision_voids_;
  ScoreTable delivered_, earned_;
  std::vector<LedgerEntry> ledger_;             ///< without gaps
  std::map<std::uint64_t, LedgerEntry> early_;  ///< entries after a gap
  std::uint64_t standing_ = 0;
  std::map<std::uint64_t, std::size_t> by_token_;  ///< to the index in ledger_
  std::vector<Held> held_;
  std::map<Key, Tick> delivered_at_;
  std::map<Key, Refusal> refused_reports_;
  std::vector<bool> collided_;  ///< by UAV, as far as the delivered tally knows
  std::uint64_t received_ = 0, duplicates_ = 0;
  std::array<std::uint64_t, kRefusals> refused_{};
  std::vector<TimelinePoint> timeline_{TimelinePoint{}};
};

}  // namespace skein::station
