#include "station/scoreboard.hpp"

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <string>
#include <tuple>

#include "core/text/sha256.hpp"

namespace skein::station {

std::string_view to_string(Refusal reason) {
  switch (reason) {
    case Refusal::unknown:
      return "unknown";
    case Refusal::borrowed:
      return "borrowed";
    case Refusal::altered:
      return "altered";
  }
  return "";
}

Scoreboard::Scoreboard(std::size_t uavs, std::size_t points, const RulesConfig& rules)
    : points_(points),
      collision_voids_(rules.collision_voids_score),
      delivered_(uavs, points, rules),
      earned_(uavs, points, rules),
      collided_(uavs, false) {}

void Scoreboard::check(const LedgerEntry& entry) const {
  const auto exists = [this](const CapturePoint& point) { return point.index < points_; };
  if (entry.uav >= collided_.size() || (!entry.collision && entry.capture.uav != entry.uav) ||
      !std::ranges::all_of(entry.capture.points, exists)) {
    throw std::invalid_argument("ledger entry " + std::to_string(entry.index) +
                                " names a UAV or a point that does not exist");
  }
}

void Scoreboard::add_entry(const LedgerEntry& entry) {
  check(entry);
  if (entry.index < ledger_.size()) {
    if (!(ledger_[entry.index] == entry)) {
      throw std::invalid_argument("ledger entry " + std::to_string(entry.index) + " came twice and differs");
    }
    return;
  }
  early_.insert_or_assign(entry.index, entry);
  while (!early_.empty() && early_.begin()->first == ledger_.size()) {
    enter(early_.begin()->second);
    early_.erase(early_.begin());
  }
}

void Scoreboard::enter(const LedgerEntry& entry) {
  if (!entry.collision) by_token_.emplace(entry.capture.token, ledger_.size());
  ledger_.push_back(entry);
}

void Scoreboard::add_report(std::size_t source, CaptureReport report) {
  ++received_;
  held_.push_back({source, std::move(report)});
}

StepOutcome Scoreboard::end_step(Tick tick, std::uint64_t upto) {
  if (!has_entries(upto)) {
    throw std::logic_error("a step was ended before the ledger's entries up to " + std::to_string(upto) + " came");
  }
  StepOutcome outcome;
  outcome.acks.resize(collided_.size());
  Before before;
  stand(upto, tick, outcome, before);
  settle(tick, outcome, before);

  Sha256 digest;
  for (const auto& [point, was] : before) {
    const PointTally& now = delivered_.points()[point];
    if (now == was) continue;
    outcome.score_changed = true;
    digest.add(point).add(now.uav).add(now.capture).add(std::bit_cast<std::uint32_t>(now.q));
  }
  if (outcome.score_changed) {
    const auto bytes = digest.digest();
    outcome.digest.assign(bytes.begin(), bytes.end());
    extend_timeline(tick);
  }
  return outcome;
}

void Scoreboard::stand(std::uint64_t upto, Tick tick, StepOutcome& outcome, Before& before) {
  for (; standing_ < upto; ++standing_) {
    const LedgerEntry& entry = ledger_[standing_];
    if (!entry.collision) {
      earned_.add(entry.capture);
      continue;
    }
    earned_.collide(entry.uav);
    if (collided_[entry.uav]) continue;  // known from the journal already
    outcome.records.push_back({tick, entry});
    apply(outcome.records.back(), before);
  }
}

void Scoreboard::settle(Tick tick, StepOutcome& outcome, Before& before) {
  std::ranges::stable_sort(
      held_, {}, [](const Held& held) { return std::tuple(held.source, held.report.uav, held.report.capture); });
  std::vector<Held> waiting;
  for (Held& held : held_) {
    const Verdict verdict = judge(held);
    switch (verdict.kind) {
      case Verdict::Kind::wait:
        ++held.steps;
        waiting.push_back(std::move(held));
        break;
      case Verdict::Kind::refused:
        ++refused_[static_cast<std::size_t>(verdict.reason)];
        if (verdict.entry != nullptr) {
          refused_reports_[{verdict.entry->uav, verdict.entry->capture.capture}] = verdict.reason;
        }
        break;
      case Verdict::Kind::accepted:
        outcome.records.push_back({tick, *verdict.entry});
        apply(outcome.records.back(), before);
        outcome.acks[held.source].push_back(held.report.capture);
        break;
      case Verdict::Kind::duplicate:  // its acknowledgement was lost
        ++duplicates_;
        outcome.acks[held.source].push_back(held.report.capture);
        break;
    }
  }
  held_ = std::move(waiting);
  for (std::vector<std::uint64_t>& acks : outcome.acks) {
    std::ranges::sort(acks);
    acks.erase(std::unique(acks.begin(), acks.end()), acks.end());
  }
}

Scoreboard::Verdict Scoreboard::judge(const Held& held) const {
  using Kind = Verdict::Kind;
  const CaptureReport& report = held.report;
  const Key key{report.uav, report.capture};
  const auto by_token = by_token_.find(report.token);
  if (by_token == by_token_.end()) {
    // The referee's entry for an unknown token may still be on its way, but not for long.
    return {held.steps < kPatience ? Kind::wait : Kind::refused, Refusal::unknown, nullptr};
  }
  const LedgerEntry& entry = ledger_[by_token->second];
  if (entry.index >= standing_) return {Kind::wait, Refusal::unknown, &entry};
  if (entry.uav != held.source) return {Kind::refused, Refusal::borrowed, &entry};
  if (!(entry.capture == report)) return {Kind::refused, Refusal::altered, &entry};
  return {delivered_at_.contains(key) ? Kind::duplicate : Kind::accepted, Refusal::unknown, &entry};
}

void Scoreboard::apply(const TallyRecord& record, Before& before) {
  const LedgerEntry& entry = record.entry;
  const std::vector<PointTally>& tally = delivered_.points();
  if (entry.collision) {
    for (std::uint32_t point = 0; point < tally.size(); ++point) {
      if (tally[point].q > 0.0F && tally[point].uav == entry.uav) before.emplace(point, tally[point]);
    }
    collided_[entry.uav] = true;
    delivered_.collide(entry.uav);
    return;
  }
  for (const CapturePoint& point : entry.capture.points) before.emplace(point.index, tally[point.index]);
  delivered_at_.emplace(Key{entry.uav, entry.capture.capture}, record.tick);
  delivered_.add(entry.capture);
}

void Scoreboard::restore(const TallyRecord& record) {
  check(record.entry);
  if (!record.entry.collision) ++received_;
  Before before;
  apply(record, before);
  const auto changed = [this](const auto& was) { return !(delivered_.points()[was.first] == was.second); };
  if (std::ranges::any_of(before, changed)) extend_timeline(record.tick);
}

void Scoreboard::extend_timeline(Tick tick) {
  const TimelinePoint now{tick, delivered_.points_detected(), delivered_.score()};
  if (timeline_.back().tick == tick) {
    timeline_.back() = now;
  } else {
    timeline_.push_back(now);
  }
}

Audit Scoreboard::audit(const LedgerEntry& entry) const {
  const Key key{entry.uav, entry.capture.capture};
  Audit audit;
  if (const auto at = delivered_at_.find(key); at != delivered_at_.end()) audit.delivered = at->second;
  if (const auto why = refused_reports_.find(key); why != refused_reports_.end()) audit.refused = why->second;
  return audit;
}

}  // namespace skein::station
