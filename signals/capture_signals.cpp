// Signals of captures: which ones were taken, delivered and acknowledged, and which work was left undone or taken over.
#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "results/run_folder.hpp"
#include "results/score_steps.hpp"
#include "signals/custody.hpp"
#include "signals/run_signals.hpp"

namespace skein::signals {
namespace {

/// Extra time for the flight of a UAV whose program has come back: unlike in the run without faults, the UAV is not at
/// its start, and it may begin its work at another place.
constexpr double kWayToWork_s = 40.0;

/// A capture whose acknowledgement by the station has reached its UAV.
struct Acknowledged {
  CaptureKey capture;
  std::size_t taken = 0, told = 0;  ///< exchanges: of the capture, and of the acknowledgement
};

std::vector<Acknowledged> acknowledged_captures(const results::RunRecord& run, const std::string& uav) {
  std::map<CaptureKey, std::size_t> taken;
  std::vector<Acknowledged> all;
  for (const results::EventRow& row : run.events) {
    if (!row.is_of_a_capture() || (!uav.empty() && row.subject != uav)) continue;
    const CaptureKey capture{row.subject, row.capture()};
    if (row.event == run_tables::kCaptured) {
      taken.emplace(capture, row.step);
    } else {
      all.push_back({capture, taken[capture], row.step});
    }
  }
  return all;
}

/// Points that this UAV photographs from `from_s` on, but not before, and that no other UAV ever photographs.
std::set<std::size_t> work_before(const results::RunRecord& run, const std::string& uav, double from_s) {
  std::set<std::size_t> own, others;
  for (const results::CaptureRow& row : run.captures) {
    (row.uav == uav && row.time_s >= from_s ? own : others).insert(row.point);
  }
  std::erase_if(own, [&](std::size_t point) { return others.contains(point); });
  return own;
}

/// Times at which this UAV, in the run `without` faults, first photographs each point that no UAV photographs in `run`
/// [s], ascending. Only captures that count.
std::vector<double> left_undone_s(const results::RunRecord& without, const std::string& uav, const Scenario& scenario,
                                  const results::RunRecord& run) {
  std::map<std::size_t, double> first_s;
  for (const results::CaptureRow& row : without.captures) {
    if (row.uav != uav || row.voided() || row.q < scenario.rules.min_point_score) continue;
    const auto [found, is_new] = first_s.try_emplace(row.point, row.time_s);
    if (!is_new) found->second = std::min(found->second, row.time_s);
  }
  for (const results::CaptureRow& row : run.captures) first_s.erase(row.point);
  std::vector<double> times_s;
  for (const auto& [point, time_s] : first_s) times_s.push_back(time_s);
  std::ranges::sort(times_s);
  return times_s;
}

}  // namespace

FolderSignals::Values FolderSignals::of_captures(const SignalUse& signal) {
  const std::string uav = signal.argument(0);
  const auto events = [&](const char* event) {
    std::vector<std::size_t> exchanges;
    for (const results::EventRow& row : run_.events) {
      if (row.event == event && (uav.empty() || row.subject == uav)) exchanges.push_back(row.step);
    }
    return counted(exchanges);
  };
  const auto stepped = [&](const std::vector<results::ScoreRow>& steps, double results::ScoreRow::*value) {
    Values values = constant(0.0);
    for (const results::ScoreRow& step : steps) {
      if (step.time_s > end_s() + 1e-6) break;
      std::fill(values.begin() + static_cast<std::ptrdiff_t>(exchange_at(step.time_s)), values.end(), step.*value);
    }
    return values;
  };
  if (signal.is("captures")) return events(run_tables::kCaptured);
  if (signal.is("acknowledged")) return events(run_tables::kReleased);
  if (signal.is("held")) {
    Values held = events(run_tables::kCaptured);
    const Values released = events(run_tables::kReleased);
    for (std::size_t k = 0; k < exchanges_; ++k) held[k] -= released[k];
    return held;
  }
  const auto derived = [&](results::Counts counts) {
    return stepped(score_steps(run_.captures, scenario_.rules.min_point_score, counts), &results::ScoreRow::score);
  };
  if (signal.is("score")) return stepped(run_.scores, &results::ScoreRow::score);
  if (signal.is("points")) return stepped(run_.scores, &results::ScoreRow::points);
  if (signal.is("earned")) return derived(results::Counts::when_taken);
  if (signal.is("delivered_score")) return derived(results::Counts::when_delivered);
  if (signal.is("lost") || signal.is("late")) {
    std::vector<std::size_t> exchanges;
    for (const results::MessageRow& row : run_.messages) {
      const bool is_meant = signal.is("late") == row.arrives.has_value() && (uav.empty() || row.uav == uav);
      if (is_meant) exchanges.push_back(row.step);
    }
    return counted(exchanges);
  }
  if (signal.is("custody_differences")) return custody_differences();
  return of_custody(signal);
}

FolderSignals::Values FolderSignals::of_custody(const SignalUse& signal) {
  const std::string uav = signal.argument(0);
  std::map<CaptureKey, std::size_t> delivered;
  for (const results::CaptureRow& row : run_.captures) {
    if (row.delivered_at_s) delivered.emplace(CaptureKey{row.uav, row.capture}, exchange_at(*row.delivered_at_s));
  }
  std::vector<std::size_t> exchanges;
  if (signal.is("delivered")) {
    for (const auto& [capture, exchange] : delivered) {
      if (uav.empty() || capture.first == uav) exchanges.push_back(exchange);
    }
    return counted(exchanges);
  }
  for (const Acknowledged& one : acknowledged_captures(run_, uav)) {
    const auto found = delivered.find(one.capture);
    const bool is_delivered = found != delivered.end() && found->second <= one.told;
    if (signal.is("acknowledged_and_delivered") ? is_delivered : has_path(one.capture.first, one.taken, one.told)) {
      exchanges.push_back(one.told);
    }
  }
  return counted(exchanges);
}

FolderSignals::Values FolderSignals::custody_differences() const {
  if (faults_ == nullptr) throw InputError("custody_differences: is known only where the faults of the run are known");
  // Exchanges in which a capture is delivered, by the derivation and by the station; `exchanges_`: never.
  std::map<CaptureKey, std::pair<std::size_t, std::size_t>> deliveries;
  const auto entry = [&](const CaptureKey& capture) -> auto& {
    return deliveries.try_emplace(capture, exchanges_, exchanges_).first->second;
  };
  for (const auto& [capture, step] : derived_deliveries(run_, scenario_, *faults_)) entry(capture).first = step;
  for (const results::CaptureRow& row : run_.captures) {
    if (!row.delivered_at_s) continue;
    entry({row.uav, row.capture}).second = exchange_at(*row.delivered_at_s);
  }
  Values values = constant(0.0);
  for (const auto& [capture, steps] : deliveries) {
    const auto [from, to] = std::minmax(steps.first, steps.second);
    for (std::size_t k = from; k < std::min(to, exchanges_); ++k) ++values[k];
  }
  return values;
}

/// Whether a report could go from a UAV to the station and its acknowledgement back, between two exchanges. What is
/// sent in one exchange arrives in the next; the sender, the router and the receiver must take part.
bool FolderSignals::has_path(const std::string& uav, std::size_t from, std::size_t to) {
  const std::string station = scenario_.node_name(kStationNode);
  const auto passes = [&](const std::vector<double>& link, const std::vector<double>& sender,
                          const std::vector<double>& receiver, std::size_t k) {
    return link[k] > 0.0 && sender[k] > 0.0 && use("member", {programs::kCommRouter})[k] > 0.0 &&
           receiver[std::min(k + 1, exchanges_ - 1)] > 0.0;
  };
  const auto& there = use("link", {uav, station});
  const auto& back = use("link", {station, uav});
  const auto& sender = use("member", {uav});
  const auto& receiver = use("member", {programs::kStation});
  to = std::min(to, exchanges_);  // events may follow the end that the result states
  std::size_t k = from;
  while (k < to && !passes(there, sender, receiver, k)) ++k;
  for (++k; k < to; ++k) {
    if (passes(back, receiver, sender, k)) return true;
  }
  return false;
}

const results::RunRecord& FolderSignals::undisturbed(const SignalUse& signal) const {
  if (undisturbed_ != nullptr) return *undisturbed_;
  throw InputError(signal.text() + ": is known only where the run is compared with one without faults");
}

FolderSignals::Values FolderSignals::of_work(const SignalUse& signal) {
  const results::RunRecord& without = undisturbed(signal);
  if (signal.is("undisturbed_score")) return constant(value_or(without.result, "score", 0.0));
  if (signal.is("undisturbed_earned")) return constant(value_or(without.result, "score_earned", 0.0));
  const std::string uav = signal.argument(0);
  if (signal.is("missed")) return missed(uav, without);
  const std::optional<double> failed = failed_s(uav);
  if (!failed) return constant(0.0);
  const double from_s = *failed;
  std::set<std::size_t> remaining = work_before(without, uav, from_s);
  if (signal.is("work_at_failure")) return counted(std::vector<std::size_t>(remaining.size(), exchange_at(from_s)));
  std::vector<std::size_t> exchanges;
  std::vector<const results::CaptureRow*> rows;
  for (const results::CaptureRow& row : run_.captures) rows.push_back(&row);
  std::ranges::stable_sort(rows, {}, [](const results::CaptureRow* row) { return row->time_s; });
  for (const results::CaptureRow* row : rows) {
    if (row->uav != uav && row->time_s >= from_s && remaining.erase(row->point) > 0) {
      exchanges.push_back(exchange_at(row->time_s));
    }
  }
  return counted(exchanges);
}

/// When a UAV's program first left; if it never did, when the first fault of this UAV began. nullopt: neither.
std::optional<double> FolderSignals::failed_s(const std::string& uav) const {
  for (const results::EventRow& row : run_.events) {
    if (row.event == run_tables::kLeft && row.subject == uav) return static_cast<double>(row.step) * period_s();
  }
  std::optional<double> first_s;
  for (const Json& fault : value_or(run_.result, "faults", Json::array())) {
    const Json began = value_or(fault, "began_step", nullptr);
    if (!began.is_number() || value_or(fault, "target", nullptr) != uav) continue;
    const double began_s = began.get<double>() * period_s();
    first_s = std::min(first_s.value_or(began_s), began_s);
  }
  return first_s;
}

/// A restarted program has lost its knowledge, and begins anew. So the same UAV's flight in the run without faults,
/// from its start on, tells by when the UAV should photograph again.
FolderSignals::Values FolderSignals::missed(const std::string& uav, const results::RunRecord& without) {
  Values values = constant(0.0);
  const std::optional<double> healed = healed_s();
  if (!healed) return values;
  const std::vector<double> undone_s = left_undone_s(without, uav, scenario_, run_);
  const Values restarts = use("restarts", {uav}), captures = use("captures", {uav}), members = use("member", {uav});
  std::size_t from = exchange_at(*healed);
  for (std::size_t k = from; k < exchanges_; ++k) {
    if (restarts[k] > restarts[from] || members[k] < 0.5) from = k;
    if (restarts[k] < 1.0 || captures[k] > captures[from]) continue;
    const double back_s = static_cast<double>(k - from) * period_s() - kWayToWork_s;
    values[k] = static_cast<double>(std::ranges::upper_bound(undone_s, back_s + 1e-6) - undone_s.begin());
  }
  return values;
}

}  // namespace skein::signals
