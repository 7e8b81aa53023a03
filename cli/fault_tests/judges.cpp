#include "cli/fault_tests/judges.hpp"

#include <cmath>
#include <set>

#include "cli/fault_tests/custody.hpp"
#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "results/diff.hpp"

namespace skein::cli {
namespace {

std::string list_text(const std::set<std::string>& names) {
  return names.empty() ? "nobody" : joined({names.begin(), names.end()});
}

double number(const results::RunRecord& run, const char* key) { return value_or(run.result, key, 0.0); }

double time_of(const results::EventRow& row, const Evidence& evidence) {
  return static_cast<double>(row.step) * evidence.scenario.exchange_period_s;
}

/// @param of  what 1 means.
Finding share_finding(const Limits& wanted, double part, double whole, const std::string& of, double end_s) {
  // To six digits, as it is shown: sums of the same captures in another order differ in their last bits.
  const double share = whole > 0.0 ? std::round(1e6 * part / whole) / 1e6 : 1.0;
  return finding(wanted.contain(share), wanted.text(),
                 number_text(share) + " (" + number_text(part) + " of " + number_text(whole) + " " + of + ")", end_s);
}

/// @param part  of the expectation that these limits are.
Findings limit_findings(const std::map<std::string, Limits>& wanted, const Json& seen, const std::string& whose,
                        const std::string& part, double end_s) {
  Findings findings;
  for (const auto& [name, limits] : wanted) {
    findings.push_back(finding(limits, value_or(seen, name.c_str(), 0.0), end_s, " " + whose + name));
    findings.back().part = part + "." + name;
  }
  return findings;
}

/// When two runs part, where their digests tell.
std::optional<double> parting_time(const results::RunRecord& run, const results::RunRecord& other) try {
  const auto difference = results::first_difference(run.dir, other.dir);
  return difference ? std::optional(difference->time_s) : std::nullopt;
} catch (const InputError&) {
  return std::nullopt;  // one of them died before it wrote any
}

}  // namespace

Finding finding(bool holds, const std::string& expected, const std::string& seen, std::optional<double> at_s) {
  return {holds, "expected " + expected + ", seen " + seen, at_s};
}

Finding finding(const Limits& wanted, double seen, double end_s, const std::string& of) {
  return finding(wanted.contain(seen), wanted.text() + of, number_text(seen), end_s);
}

const Fault* first_fault_of(const std::string& uav, const FaultPlan& plan) {
  const Fault* first = nullptr;
  for (const Fault& fault : plan.faults) {
    const auto when = [](const Fault& one) { return std::pair(one.waits, one.at_s); };
    if (fault_target(fault) == uav && (!first || when(fault) < when(*first))) first = &fault;
  }
  return first;
}

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

Findings judge_text(const char* key, const std::string& wanted, const Evidence& evidence) {
  const std::string seen = value_or(evidence.run.result, key, "nothing");
  return {finding(seen == wanted, wanted, seen, evidence.end_s())};
}

Findings judge_number(const char* path, const Limits& wanted, const Evidence& evidence) {
  const Json::json_pointer pointer(path);
  const Json& result = evidence.run.result;
  const bool known = result.contains(pointer) && result[pointer].is_number();
  return {finding(wanted, known ? result[pointer].get<double>() : 0.0, evidence.end_s())};
}

Findings judge_vs_fault_free(const char* key, const Limits& wanted, const Evidence& evidence) {
  return {share_finding(wanted, number(evidence.run, key), number(*evidence.fault_free, key), "without faults",
                        evidence.end_s())};
}

Findings judge_vs_earned(const Limits& wanted, const Evidence& evidence) {
  return {share_finding(wanted, number(evidence.run, "score"), number(evidence.run, "score_earned"), "earned",
                        evidence.end_s())};
}

Findings judge_exit_code(const Limits& wanted, const Evidence& evidence) {
  return {finding(wanted, evidence.exit_code, evidence.end_s())};
}

Findings judge_deterministic(bool wanted, const Evidence& evidence) {
  const bool seen = value_or(evidence.run.result, "deterministic", false) &&
                    value_or(evidence.run.result, "digest", nullptr).is_string();
  return {finding(seen == wanted, wanted ? "a digest" : "no digest", seen ? "one" : "none", evidence.end_s())};
}

Findings judge_faults_acted(bool wanted, const Evidence& evidence) {
  const Json entries = value_or(evidence.run.result, "faults", Json::array());
  Findings findings;
  for (std::size_t i = 0; i < evidence.plan.faults.size(); ++i) {
    const Fault& fault = evidence.plan.faults[i];
    const bool began = i < entries.size() && value_or(entries[i], "began_step", nullptr).is_number();
    const std::string time = fault.waits ? " when " + fault.when->text : " at " + number_text(fault.at_s) + " s";
    findings.push_back(
        {began == wanted, "expected that " + fault_kind(fault) + " of " + fault_target(fault) +
                              (wanted ? " begins" : " does not begin") + time + ", seen that it " +
                              (began ? "did" : "did not; the run ended at " + number_text(evidence.end_s()) + " s")});
  }
  return findings;
}

Findings judge_collisions(const Limits& wanted, const Evidence& evidence) {
  const Json collisions = value_or(evidence.run.result, "collisions", Json::array());
  std::string seen = std::to_string(collisions.size());
  for (const Json& collision : collisions) {
    seen += "; " + value_or(collision, "uav", "").get<std::string>() + " with " +
            value_or(collision, "with", "").get<std::string>() + " at " +
            number_text(value_or(collision, "time_s", 0.0)) + " s";
  }
  return {finding(wanted.contain(static_cast<double>(collisions.size())), wanted.text(), seen)};
}

Findings judge_members(const char* event, const std::vector<std::string>& wanted, const Evidence& evidence) {
  const std::set<std::string> expected(wanted.begin(), wanted.end());
  std::set<std::string> seen;
  std::optional<double> at_s;  // of the first who should not; else it is the end that shows who is missing
  for (const results::EventRow& row : evidence.run.events) {
    if (row.event != event || row.step == 0) continue;
    seen.insert(row.subject);
    if (!at_s && !expected.contains(row.subject)) at_s = time_of(row, evidence);
  }
  return {finding(seen == expected, list_text(expected), list_text(seen), at_s.value_or(evidence.end_s()))};
}

Findings judge_radio(const RadioLimits& wanted, const Evidence& evidence) {
  return limit_findings(wanted.limits, value_or(evidence.run.result, "radio", Json::object()), "", "",
                        evidence.end_s());
}

Findings judge_uavs(const UavLimits& wanted, const Evidence& evidence) {
  Findings findings;
  for (const auto& [name, limits] : wanted) {
    Json seen;
    for (const Json& uav : value_or(evidence.run.result, "uavs", Json::array())) {
      if (value_or(uav, "name", "") == name) seen = uav;
    }
    const Findings of_uav = limit_findings(limits.limits, seen, "for " + name + "'s ", "." + name, evidence.end_s());
    findings.insert(findings.end(), of_uav.begin(), of_uav.end());
  }
  return findings;
}

/// The work in hand: points that, without the fault, this UAV is the first to photograph after its fault, and that
/// nobody else photographs before the time is over. Taken over is each that now somebody else photographs in time.
Findings judge_taken_over(const TakenOver& wanted, const Evidence& evidence) {
  const double from_s = first_fault_of(wanted.uav, evidence.plan)->at_s, until_s = from_s + wanted.within_s;
  std::set<int> in_hand, others, done;
  for (const results::CaptureRow& row : evidence.fault_free->captures) {
    if (row.uav == wanted.uav ? row.time_s < from_s : row.time_s <= until_s) others.insert(row.point);
    if (row.uav == wanted.uav && row.time_s >= from_s) in_hand.insert(row.point);
  }
  for (const int point : others) in_hand.erase(point);
  for (const results::CaptureRow& row : evidence.run.captures) {
    const bool in_time = row.time_s >= from_s && row.time_s <= until_s;
    if (in_time && row.uav != wanted.uav && in_hand.contains(row.point)) done.insert(row.point);
  }
  return {finding(done.size() >= static_cast<std::size_t>(wanted.points),
                  "others to photograph at least " + std::to_string(wanted.points) + " of the " +
                      std::to_string(in_hand.size()) + " points that " + wanted.uav + " had before it, from " +
                      number_text(from_s) + " to " + number_text(until_s) + " s",
                  std::to_string(done.size()))};
}

Findings judge_custody(Custody wanted, const Evidence& evidence) {
  if (wanted == Custody::none) return {};
  Findings findings;
  const auto add = [&](const std::vector<std::string>& sentences) {
    for (const std::string& sentence : sentences) findings.push_back({false, sentence});
  };
  add(custody_losses(evidence.run, evidence.scenario));
  if (wanted == Custody::exact) add(custody_differences(evidence.run, evidence.scenario, evidence.plan));
  if (findings.empty()) findings.push_back(finding(true, name_of(wanted), "that it is"));
  return findings;
}

Findings judge_same_digest(const std::vector<Repeat>&, const Evidence& evidence) {
  const Json digest = value_or(evidence.run.result, "digest", nullptr);
  Findings findings;
  for (const auto& [how, run] : evidence.repeats) {
    const Json other = value_or(run->result, "digest", nullptr);
    const bool same = digest.is_string() && digest == other;
    findings.push_back(
        finding(same, "the digest " + digest.dump() + " of the repetition '" + how + "' too",
                other.dump() + (same ? "" : "; compare " + evidence.run.dir.string() + " with " + run->dir.string()),
                same ? std::nullopt : parting_time(evidence.run, *run)));
  }
  return findings;
}

}  // namespace skein::cli
