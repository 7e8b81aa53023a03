#include "sim_server/record/fault_timeline.hpp"

#include <spdlog/fmt/fmt.h>

namespace skein::sim {
namespace {

std::string title(const Fault& fault) {
  const std::string target = fault_target(fault);
  const std::string text = target.empty() ? fault_kind(fault) : fault_kind(fault) + " of " + target;
  return fault.when ? text + ", which waited for " + fault.when->text : text;
}

}  // namespace

std::vector<std::string> FaultTimeline::enter_step(std::uint64_t step, Tick tick) {
  std::vector<std::string> lines;
  changes_.clear();
  entries_.resize(faults_.size());
  for (std::size_t i = 0; i < faults_.size(); ++i) {
    Entry& entry = entries_[i];
    if (!entry.began && faults_[i].active(tick)) {
      entry.began = step;
      changes_.push_back({i, true});
      lines.push_back(fmt::format("fault at {:.2f} s (step {}): {}", seconds(tick), step, title(faults_[i])));
    } else if (entry.began && !entry.ended && !faults_[i].active(tick)) {
      entry.ended = step;
      changes_.push_back({i, false});
      lines.push_back(fmt::format("end of fault at {:.2f} s (step {}): {}", seconds(tick), step, title(faults_[i])));
    }
  }
  return lines;
}

std::vector<FaultReport> FaultTimeline::report() const {
  std::vector<FaultReport> report;
  for (std::size_t i = 0; i < faults_.size(); ++i) {
    const Entry entry = i < entries_.size() ? entries_[i] : Entry{};  // added since the last step: it has not begun
    report.push_back({.kind = fault_kind(faults_[i]),
                      .target = fault_target(faults_[i]),
                      .at_s = faults_[i].waits ? std::nullopt : std::optional(faults_[i].at_s),
                      .until_s = faults_[i].until_s,
                      .began_step = entry.began,
                      .ended_step = entry.ended,
                      .when = faults_[i].when ? std::optional(faults_[i].when->text) : std::nullopt});
  }
  return report;
}

}  // namespace skein::sim
