#include "signals/custody.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/scoring/score_table.hpp"
#include "results/run_folder.hpp"
#include "results/run_tables.hpp"

namespace skein::signals {
namespace {

/// A value that changes at given steps; false before the first change.
class Switch {
 public:
  void set(std::uint64_t step, bool on) { changes_[step] = on; }
  bool on(std::uint64_t step) const {
    const auto after = changes_.upper_bound(step);
    return after != changes_.begin() && std::prev(after)->second;
  }

 private:
  std::map<std::uint64_t, bool> changes_;
};

std::uint64_t step_of(double time_s, const Scenario& scenario) {
  return static_cast<std::uint64_t>(std::llround(time_s / scenario.exchange_period_s));
}

/// The plan with the times at which its faults began in a run, also those that waited for a condition.
FaultPlan as_flown(FaultPlan plan, const Json& result, const Scenario& scenario) {
  const Json entries = value_or(result, "faults", Json::array());
  for (std::size_t i = 0; i < std::min(plan.faults.size(), entries.size()); ++i) {
    const Json step = value_or(entries[i], "began_step", nullptr);
    if (plan.faults[i].waits && step.is_number()) {
      plan.faults[i].set_off(step.get<Tick>() * scenario.exchange_ticks());
    }
  }
  return plan;
}

/// The events of a run, by step, as the derivation needs them.
class Timeline {
 public:
  Timeline(const results::RunRecord& run, const Scenario& scenario, const FaultPlan& plan)
      : scenario_(scenario),
        plan_(as_flown(plan, run.result, scenario)),
        last_step_(step_of(value_or(run.result, "sim_time_s", 0.0), scenario)) {
    const std::string& station = scenario.node_name(kStationNode);
    for (const results::EventRow& row : run.events) {
      if (row.event == run_tables::kJoined || row.event == run_tables::kLeft)
        present_[row.subject].set(row.step, row.event == run_tables::kJoined);
      if (row.is_of_a_link() && row.object == station)
        linked_[row.subject].set(row.step, row.event == run_tables::kLinkUp);
      if (row.event == run_tables::kCaptured) captured_[row.subject][row.step].push_back(row.capture());
      if (row.event == run_tables::kReleased) released_[{row.subject, row.capture()}] = row.step;
    }
    for (const results::MessageRow& row : run.messages) messages_[{row.uav, row.step}] = row.arrives;
  }

  std::uint64_t last_step() const { return last_step_; }
  bool present(const std::string& member, std::uint64_t step) const {
    const auto found = present_.find(member);
    return found != present_.end() && found->second.on(step);
  }
  bool linked(const std::string& uav, std::uint64_t step) const {
    const auto found = linked_.find(uav);
    return found != linked_.end() && found->second.on(step);
  }
  /// Numbers of the captures that the camera handed out in this step.
  std::vector<std::uint64_t> captured(const std::string& uav, std::uint64_t step) const {
    const auto found = captured_.find(uav);
    if (found == captured_.end()) return {};
    const auto at = found->second.find(step);
    return at == found->second.end() ? std::vector<std::uint64_t>() : at->second;
  }
  bool released_before(const CaptureKey& capture, std::uint64_t step) const {
    const auto found = released_.find(capture);
    return found != released_.end() && found->second < step;
  }
  /// Whether a fault pauses this absent member.
  bool paused(const std::string& member, std::uint64_t step) const {
    const auto tick = static_cast<Tick>(step) * scenario_.exchange_ticks();
    return std::any_of(plan_.faults.begin(), plan_.faults.end(), [&](const Fault& fault) {
      const auto* pause = std::get_if<Pause>(&fault.action);
      return pause != nullptr && pause->member == member && fault.active(tick);
    });
  }
  /// The step in which a message that this UAV sends in step `sent` reaches the station; nullopt: it is lost.
  std::optional<std::uint64_t> arrival(const std::string& uav, std::uint64_t sent) const {
    if (!present(programs::kCommRouter, sent) || is_cut(uav, sent)) return std::nullopt;
    std::optional<std::uint64_t> arrives = sent + 1;
    if (const auto found = messages_.find({uav, sent}); found != messages_.end()) arrives = found->second;
    if (!arrives) return std::nullopt;
    // The router hands out a delayed message in the step before it arrives. A router that was away meanwhile has lost
    // the message.
    for (std::uint64_t k = sent + 1; k < *arrives; ++k) {
      if (!present(programs::kCommRouter, k)) return std::nullopt;
    }
    // The router hands on nothing to a program that is not a member, and keeps nothing until it comes back.
    const bool received = present(programs::kCommRouter, *arrives) && present(programs::kStation, *arrives - 1) &&
                          present(programs::kStation, *arrives);
    if (*arrives > last_step_ || !received) return std::nullopt;
    return arrives;
  }

 private:
  bool is_cut(const std::string& uav, std::uint64_t step) const {
    const auto cut = cut_links(plan_, scenario_, static_cast<Tick>(step) * scenario_.exchange_ticks());
    return cut && cut->at(node_of_uav(scenario_.uav_index(uav)), kStationNode) != 0;
  }

  const Scenario& scenario_;
  const FaultPlan plan_;
  const std::uint64_t last_step_;
  std::map<std::string, Switch> present_, linked_;  ///< by member; by UAV, to the station
  std::map<std::string, std::map<std::uint64_t, std::vector<std::uint64_t>>> captured_;
  std::map<CaptureKey, std::uint64_t> released_;
  std::map<std::pair<std::string, std::uint64_t>, std::optional<std::uint64_t>> messages_;
};

/// One UAV's on-board software and its camera's card.
class Sender {
 public:
  Sender(const std::string& uav, const Timeline& timeline) : uav_(uav), timeline_(timeline) {}

  void step(std::uint64_t k, std::map<CaptureKey, std::uint64_t>& delivered) {
    const bool here = timeline_.present(uav_, k);
    if (here && !was_here_) {
      if (!standing_still_) held_.clear();
      for (const std::uint64_t capture : card_) {
        if (!timeline_.released_before({uav_, capture}, k)) held_.try_emplace(capture, std::nullopt);
      }
    }
    if (!here && was_here_) standing_still_ = timeline_.paused(uav_, k);
    was_here_ = here;
    for (const std::uint64_t capture : timeline_.captured(uav_, k)) {
      card_.push_back(capture);
      if (here) held_.try_emplace(capture, std::nullopt);
    }
    if (!here || !timeline_.linked(uav_, k)) return;
    for (auto& [capture, sent] : held_) {
      if (sent && k < *sent + kResendSteps) continue;
      if (timeline_.released_before({uav_, capture}, k + 1)) continue;
      sent = k;
      const auto arrival = timeline_.arrival(uav_, k);
      if (!arrival) continue;
      const auto [entry, first] = delivered.try_emplace({uav_, capture}, *arrival);
      entry->second = std::min(entry->second, *arrival);
    }
  }

 private:
  const std::string& uav_;
  const Timeline& timeline_;
  std::vector<std::uint64_t> card_;
  std::map<std::uint64_t, std::optional<std::uint64_t>> held_;  ///< capture, step of the last attempt
  bool was_here_ = false, standing_still_ = false;
};

}  // namespace

std::map<CaptureKey, std::uint64_t> derived_deliveries(const results::RunRecord& run, const Scenario& scenario,
                                                       const FaultPlan& plan) {
  const Timeline timeline(run, scenario, plan);
  const std::vector<std::string> uavs = scenario.uav_names();
  std::map<CaptureKey, std::uint64_t> delivered;
  for (const std::string& uav : uavs) {
    Sender sender(uav, timeline);
    for (std::uint64_t k = 0; k <= timeline.last_step(); ++k) sender.step(k, delivered);
  }
  return delivered;
}

}  // namespace skein::signals
