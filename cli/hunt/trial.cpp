#include "cli/hunt/trial.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "cli/hunt/fault_maker.hpp"
#include "core/faults/fault_writer.hpp"
#include "core/text/sha256.hpp"
#include "core/text/text.hpp"
#include "host/supervisor.hpp"
#include "results/result.hpp"
#include "results/run_folder.hpp"
#include "results/run_record.hpp"
#include "signals/judge.hpp"
#include "signals/run_signals.hpp"

namespace skein::cli {
namespace {

using properties::Verdict;
using Outcome = Verdict::Outcome;

constexpr std::array<EnumName<Outcome>, 3> kOutcomes = {
    {{"holds", Outcome::holds}, {"fails", Outcome::fails}, {"vacuous", Outcome::vacuous}}};

/// The finding of kCompletes: whether the run went to its end, with a digest, and lost no program.
TrialFinding completes(const std::filesystem::path& dir, const ExitStatus& exit, const Json& result) {
  TrialFinding finding{kCompletes, Outcome::holds, {}, 0.0, "completed, with a digest"};
  const std::string status = value_or(result, "status", "none").get<std::string>();
  const Json lost = value_or(result, "lost_members", Json::array());
  const bool whole = status == "completed" || status == "no_takeoff";
  if (exit.ok() && whole && value_or(result, "digest", nullptr).is_string() && lost.empty()) return finding;
  finding.outcome = Outcome::fails;
  finding.at_s = value_or(result, "sim_time_s", 0.0);
  finding.text = "skein run ended with " + exit.text() + ", status " + status;
  for (const Json& member : lost) {
    finding.text += "; " + text_in(member, "member") + " was lost at " + number_text(value_or(member, "time_s", 0.0)) +
                    " s: " + text_in(member, "reason");
  }
  for (const Json& warning : value_or(result, "warnings", Json::array())) {
    if (warning.is_string() && results::is_failure(warning.get<std::string>()))
      finding.text += "; " + warning.get<std::string>();
  }
  if (!result.is_object()) {
    for (const std::string& line : last_lines(dir / run_folder::kFlightLog, 3)) finding.text += "; " + line;
  }
  return finding;
}

TrialFinding finding_of(const signals::PropertyFinding& found) {
  const Verdict& verdict = found.verdict;
  TrialFinding finding{found.name, verdict.outcome, {}, verdict.at_s, found.text()};
  if (verdict.outcome != Outcome::vacuous && std::isfinite(verdict.margin)) finding.margin = verdict.margin;
  return finding;
}

std::uint64_t hash_of(const std::string& text) {
  std::uint64_t hash = 14695981039346656037ULL;  // FNV-1a
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return hash;
}

SignalUse use_of(const std::string& name, std::vector<std::string> arguments = {}) {
  const auto& table = signal_table();
  const auto found = std::ranges::find(table, name, [](const SignalInfo& info) { return std::string(info.name); });
  return {&*found, std::move(arguments)};
}

/// Connected components of the nodes, by the links of one exchange. As text, each node has the number of the first node
/// of its component: "0 0 2 0 ".
class Components {
 public:
  Components(properties::RunSignals& signals, const Scenario& scenario) : nodes_(scenario.fleet.size() + 1) {
    for (const Node a : scenario.nodes()) {
      for (const Node b : scenario.nodes()) {
        if (a >= b) continue;
        links_.push_back({a, b, &signals.values(use_of("link", {scenario.node_name(a), scenario.node_name(b)}))});
      }
    }
  }

  std::string at(std::size_t exchange) const {
    std::vector<std::size_t> group(nodes_);
    for (std::size_t i = 0; i < nodes_; ++i) group[i] = i;
    for (bool changed = true; changed;) {
      changed = false;
      for (const auto& [a, b, open] : links_) {
        if ((*open)[exchange] < 0.5 || group[a] == group[b]) continue;
        group[a] = group[b] = std::min(group[a], group[b]);
        changed = true;
      }
    }
    std::string text;
    for (const std::size_t one : group) text += std::to_string(one) + " ";
    return text;
  }

 private:
  struct Pair {
    std::size_t a, b;
    const std::vector<double>* open;
  };
  const std::size_t nodes_;
  std::vector<Pair> links_;
};

constexpr double kStatePeriod_s = 0.5;  ///< between two samples of the fleet's state
constexpr int kPhases = 4;

/// Class of an amount: 0 none, 1 few, 2 many.
int amount(double count) { return count < 0.5 ? 0 : count < 10.0 ? 1 : 2; }

std::set<std::string> kinds_in_force(const std::vector<Fault>& faults, const TrialOutcome& outcome, double time_s) {
  std::set<std::string> kinds;
  for (std::size_t i = 0; i < faults.size() && i < outcome.began_s.size(); ++i) {
    const auto begin_s = outcome.began_s[i];
    if (!begin_s || time_s < *begin_s) continue;
    // A fault that waited for a condition ends at the earlier of until_s and begin_s + for_s.
    const double end_s = std::min(faults[i].until_s.value_or(1e9), *begin_s + faults[i].for_s.value_or(1e9));
    if (time_s < end_s) kinds.insert(fault_kind(faults[i]));
  }
  return kinds;
}

}  // namespace

std::string Trial::text() const {
  std::string text = "faults:\n";
  if (faults.empty()) text = "faults: []\n";
  for (const Fault& fault : faults) text += "  - " + fault_line(fault) + "\n";
  return text;
}

const TrialFinding* TrialOutcome::find(const std::string& property) const {
  const auto found = std::ranges::find(findings, property, &TrialFinding::property);
  return found == findings.end() ? nullptr : &*found;
}

bool TrialOutcome::fails(const std::string& property) const {
  const TrialFinding* finding = find(property);
  return finding != nullptr && finding->fails();
}

Json TrialOutcome::to_json() const {
  Json json{
      {"digest", digest}, {"score", score}, {"end_s", end_s}, {"findings", Json::array()}, {"began_s", Json::array()}};
  for (const TrialFinding& finding : findings) {
    const auto* name = std::ranges::find(kOutcomes, finding.outcome, &EnumName<Outcome>::value);
    json["findings"].push_back({{"property", finding.property},
                                {"outcome", name->name},
                                {"margin", finding.margin ? Json(*finding.margin) : Json()},
                                {"at_s", finding.at_s},
                                {"text", finding.text}});
  }
  for (const auto& begin : began_s) json["began_s"].push_back(begin ? Json(*begin) : Json());
  json["states"] = states;
  return json;
}

std::optional<TrialOutcome> TrialOutcome::from_json(const Json& json) try {
  TrialOutcome outcome;
  outcome.digest = json.at("digest").get<std::string>();
  outcome.score = json.at("score").get<double>();
  outcome.end_s = json.at("end_s").get<double>();
  for (const Json& one : json.at("findings")) {
    TrialFinding& finding = outcome.findings.emplace_back();
    finding.property = one.at("property").get<std::string>();
    const std::string name = one.at("outcome").get<std::string>();
    const auto* known = std::ranges::find(kOutcomes, name, [](const auto& entry) { return std::string(entry.name); });
    if (known == kOutcomes.end()) return std::nullopt;
    finding.outcome = known->value;
    if (one.at("margin").is_number()) finding.margin = one["margin"].get<double>();
    finding.at_s = one.at("at_s").get<double>();
    finding.text = one.at("text").get<std::string>();
  }
  for (const Json& begin : json.at("began_s")) {
    outcome.began_s.push_back(begin.is_number() ? std::optional(begin.get<double>()) : std::nullopt);
  }
  outcome.states = json.at("states").get<std::vector<std::uint64_t>>();
  return outcome;
} catch (const Json::exception&) {
  return std::nullopt;
}

properties::PropertySet asked_of(const std::vector<Fault>& faults, const properties::PropertySet& set) {
  std::set<std::string> words;
  for (const Fault& fault : faults) {
    for (std::string& word : words_of(fault)) words.insert(std::move(word));
  }
  properties::PropertySet asked;
  for (const properties::NamedProperty& property : set) {
    const bool fits = std::ranges::none_of(property.not_with, [&](const auto& word) { return words.contains(word); });
    if (fits) asked.push_back(property);
  }
  return asked;
}

TrialOutcome read_outcome(const std::filesystem::path& dir, const ExitStatus& exit, const Trial& trial,
                          const properties::PropertySet& set, const Scenario& scenario,
                          const std::optional<std::filesystem::path>& undisturbed) {
  TrialOutcome outcome;
  const Json result = read_json(dir / run_folder::kResult);
  outcome.findings.push_back(completes(dir, exit, result));
  const Json digest = value_or(result, "digest", nullptr);
  if (digest.is_string()) outcome.digest = digest.get<std::string>();
  outcome.score = value_or(result, "score", 0.0);
  outcome.end_s = value_or(result, "sim_time_s", 0.0);
  for (const Json& fault : value_or(result, "faults", Json::array())) {
    const Json step = value_or(fault, "began_step", nullptr);
    outcome.began_s.push_back(step.is_number() ? std::optional(step.get<double>() * scenario.exchange_period_s)
                                               : std::nullopt);
  }
  if (outcome.findings.front().fails()) return outcome;  // its files may be incomplete
  const results::RunRecord run = results::read_run(dir);
  std::optional<results::RunRecord> without;
  if (undisturbed) without = results::read_run(*undisturbed);
  FaultPlan plan;
  plan.faults = trial.faults;
  signals::FolderSignals signals(run, scenario, without ? &*without : nullptr, &plan);
  for (const signals::PropertyFinding& found : signals::judge_properties(asked_of(trial.faults, set), signals)) {
    outcome.findings.push_back(finding_of(found));
  }
  outcome.states = states_of(signals, scenario, trial.faults, outcome);
  return outcome;
}

std::vector<std::uint64_t> states_of(properties::RunSignals& signals, const Scenario& scenario,
                                     const std::vector<Fault>& faults, const TrialOutcome& outcome) {
  std::vector<std::string> programs = scenario.uav_names();
  programs.insert(programs.end(), {programs::kStation, programs::kCommRouter});
  std::vector<const std::vector<double>*> members;
  for (const std::string& program : programs) members.push_back(&signals.values(use_of("member", {program})));
  const std::vector<double>& held = signals.values(use_of("held"));
  const Components components(signals, scenario);
  const auto stride = static_cast<std::size_t>(std::max(1.0, std::round(kStatePeriod_s / signals.period_s())));
  std::set<std::uint64_t> states;
  for (std::size_t k = 0; k < signals.exchanges(); k += stride) {
    const double time_s = static_cast<double>(k) * signals.period_s();
    std::string text;
    for (const auto* member : members) text += (*member)[k] > 0.5 ? "1" : "0";
    for (const std::string& kind : kinds_in_force(faults, outcome, time_s)) text += " " + kind;
    text += "; " + components.at(k) + "; " + std::to_string(amount(held[k])) + "; " +
            std::to_string(kPhases * k / signals.exchanges());
    states.insert(hash_of(text));
  }
  return {states.begin(), states.end()};
}

}  // namespace skein::cli
