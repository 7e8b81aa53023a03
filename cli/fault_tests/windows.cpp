#include "cli/fault_tests/windows.hpp"
#include "results/run_tables.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/text/text.hpp"

namespace skein::cli {
namespace {

/// What happened between two times, both included, since they may fall on a step.
class Span {
 public:
  Span(const Window& window, const Evidence& evidence)
      : run_(evidence.run),
        period_s_(evidence.scenario.exchange_period_s),
        from_s_(window.after_s),
        until_s_(window.until_s.value_or(std::max(evidence.end_s(), window.after_s))) {}

  double end_s() const { return until_s_; }

  /// @param uav  empty: all of them. @returns the times of what is counted, in their order.
  std::vector<double> times(const std::string& counted, const std::string& uav) const {
    std::vector<double> times;
    if (counted == "lost" || counted == "late") {
      for (const results::MessageRow& row : run_.messages) {
        const double time_s = static_cast<double>(row.step) * period_s_;
        if ((counted == "late") == row.arrives.has_value() && is(row.uav, uav) && holds(time_s))
          times.push_back(time_s);
      }
      return times;
    }
    if (counted == "acknowledged") {
      for (const results::EventRow& row : run_.events) {
        const double time_s = static_cast<double>(row.step) * period_s_;
        if (row.event == run_tables::kReleased && is(row.subject, uav) && holds(time_s)) times.push_back(time_s);
      }
      return times;
    }
    std::set<std::pair<std::string, std::uint64_t>> known;  // a capture has a row for each of its points
    for (const results::CaptureRow& row : run_.captures) {
      if (!is(row.uav, uav) || !known.emplace(row.uav, row.capture).second) continue;
      const std::optional<double> time_s = counted == "captures" ? std::optional(row.time_s) : row.delivered_at_s;
      if (time_s && holds(*time_s)) times.push_back(*time_s);
    }
    std::sort(times.begin(), times.end());
    return times;
  }

  double distance_m(const std::string& uav) const {
    std::map<std::string, Vector3d> last;
    double sum = 0.0;
    for (const results::PositionRow& row : run_.positions) {
      if (!is(row.uav, uav) || !holds(row.time_s)) continue;
      const auto [at, is_first] = last.try_emplace(row.uav, row.p_W);
      if (!is_first) sum += (row.p_W - at->second).norm();
      at->second = row.p_W;
    }
    return sum;
  }

  double score_gained() const {
    double before = 0.0, after = 0.0;
    for (const results::ScoreRow& row : run_.scores) {
      if (row.time_s < from_s_) before = row.score;
      if (row.time_s <= until_s_) after = row.score;
    }
    return after - before;
  }

 private:
  static bool is(const std::string& uav, const std::string& wanted) { return wanted.empty() || uav == wanted; }
  bool holds(double time_s) const { return time_s >= from_s_ - 1e-9 && time_s <= until_s_ + 1e-9; }

  const results::RunRecord& run_;
  const double period_s_, from_s_, until_s_;
};

Findings judge_numbers(const std::map<std::string, Limits>& wanted, const std::string& uav, const Span& span,
                       const std::string& when) {
  Findings findings;
  for (const auto& [name, limits] : wanted) {
    const std::string of = " " + name + (uav.empty() ? "" : " of " + uav) + when;
    double end_s = span.end_s(), seen = 0.0;
    if (name == "score") {
      seen = span.score_gained();
    } else if (name == "distance_m") {
      seen = span.distance_m(uav);
    } else {
      const std::vector<double> times = span.times(name, uav);
      seen = static_cast<double>(times.size());
      const bool too_many = limits.at_most && seen > *limits.at_most;
      if (too_many) end_s = times[static_cast<std::size_t>(std::max(0.0, std::floor(*limits.at_most)))];
    }
    findings.push_back(finding(limits, seen, end_s, of));
    findings.back().part = (uav.empty() ? "." : ".uavs." + uav + ".") + name;
  }
  return findings;
}

}  // namespace

Findings judge_during(const std::vector<Window>& windows, const Evidence& evidence) {
  Findings findings;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    const Window& window = windows[i];
    const Span span(window, evidence);
    const std::string when = " from " + number_text(window.after_s) + " to " + number_text(span.end_s()) + " s";
    const auto add = [&](const Findings& more) {
      for (Finding finding : more) {
        finding.part = "[" + std::to_string(i) + "]" + finding.part;
        findings.push_back(std::move(finding));
      }
    };
    add(judge_numbers(window.all.limits, "", span, when));
    for (const auto& [uav, limits] : window.uavs) add(judge_numbers(limits.limits, uav, span, when));
  }
  return findings;
}

}  // namespace skein::cli
