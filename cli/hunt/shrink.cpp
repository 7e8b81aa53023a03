#include "cli/hunt/shrink.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "cli/fault_tests/flights.hpp"
#include "cli/hunt/draws.hpp"
#include "cli/hunt/fault_maker.hpp"
#include "cli/hunt/weather_faults.hpp"
#include "core/faults/fault_check.hpp"
#include "core/overloaded.hpp"
#include "core/scenario/conditions.hpp"
#include "core/text/words.hpp"

namespace skein::cli {
namespace {

constexpr double kLeastMission_s = 10.0, kLeastLength_s = 0.5;
constexpr double kAfterSeen_s = 5.0;  ///< time that a mission goes on after the failure
constexpr const char* kSimplestScene = "towers";

double to_multiple(double value, double step) { return std::round(value / step) * step; }

double length_of_fault(const Fault& fault) {
  return fault.waits ? fault.for_s.value_or(0.0) : fault.until_s.value_or(fault.at_s) - fault.at_s;
}
Fault with_times(Fault fault, double at_s, double length_s) {
  if (fault.waits) {
    fault.for_s = length_s;
  } else if (fault.until_s) {  // else it has no end
    fault.until_s = tenths(at_s + length_s);
  }
  fault.at_s = tenths(at_s);
  return fault;
}

/// Whether a fault, or the condition that it waits for, names one of these UAVs.
bool names_any(const Fault& fault, const std::set<std::string>& of) {
  std::set<std::string> names;
  const auto add = [&names](const std::vector<std::string>& more) { names.insert(more.begin(), more.end()); };
  std::visit(Overloaded{[&](const LinkEffect& f) {
                          add(f.from);
                          add(f.to);
                        },
                        [&](const Partition& f) { std::ranges::for_each(f.groups, add); }, [](const StationOutage&) {},
                        [](const ConditionsChange&) {}, [&](const Kill& f) { names.insert(f.member); },
                        [&](const Pause& f) { names.insert(f.member); }, [&](const auto& f) { names.insert(f.uav); }},
             fault.action);
  const std::string condition = fault.waits ? fault.when->text : "";
  return std::ranges::any_of(
      of, [&](const std::string& name) { return names.contains(name) || has_word(condition, name); });
}

std::string identity(const Trial& trial) { return what_is_flown(trial.run) + trial.text(); }

/// Whether the number of faults or UAVs differs: then a simplification that was refused for one may work for the other.
bool is_other_setting(const Trial& a, const Trial& b) {
  return a.faults.size() != b.faults.size() || a.run.uavs != b.run.uavs;
}

class Proposals {
 public:
  Proposals(const Trial& trial, const TrialOutcome& outcome, const Scenario& scenario, std::optional<double> after_s)
      : trial_(trial), outcome_(outcome), scenario_(scenario), after_s_(after_s) {}

  std::vector<Proposal> all(const std::string& property) {
    const TrialFinding* finding = outcome_.find(property);
    seen_s_ = finding != nullptr ? finding->at_s : 0.0;
    shorter_mission();
    fewer_faults();
    fewer_uavs();
    plainer_run();
    for (std::size_t i = 0; i < trial_.faults.size(); ++i) without_waiting(i);
    for (std::size_t i = 0; i < trial_.faults.size(); ++i) shorter(i);
    for (std::size_t i = 0; i < trial_.faults.size(); ++i) weaker(i);
    for (std::size_t i = 0; i < trial_.faults.size(); ++i) rounder(i);
    return std::move(proposals_);
  }

 private:
  void propose(const std::string& what, Trial trial) {
    // `skein check` refuses a fault in whose time no exchange begins. Rounding of times can make such a fault.
    if (!std::ranges::all_of(trial.faults, [&](const Fault& fault) { return has_exchange(fault, scenario_); })) return;
    trial.faults = without_contradictions(std::move(trial.faults));
    if (identity(trial) != identity(trial_)) proposals_.push_back({what, std::move(trial)});
  }
  /// Proposes a trial under plainer conditions, unless they make one of its faults impossible.
  void propose_under(const std::string& what, const std::string& conditions) {
    Trial trial = trial_;
    trial.run.conditions = conditions;
    const ConditionsConfig there = chosen_conditions(conditions, scenario_.conditions);
    if (std::ranges::all_of(trial.faults, [&](const Fault& fault) { return is_possible(fault, there); })) {
      propose(what, std::move(trial));
    }
  }
  void propose(const std::string& what, std::size_t index, Fault fault) {
    Trial trial = trial_;
    trial.faults[index] = std::move(fault);
    propose(what + " " + std::to_string(index), std::move(trial));
  }

  void fewer_faults() {
    const std::size_t count = trial_.faults.size();
    Trial trial = trial_;
    std::erase_if(trial.faults, [&](const Fault& fault) { return fault.at_s > seen_s_; });
    propose("nothing afterwards", trial);
    if (count > 1) propose("no faults", Trial{trial_.run, {}});
    if (count > 3) {
      const auto half = trial_.faults.begin() + static_cast<std::ptrdiff_t>(count / 2);
      propose("first half", Trial{trial_.run, {trial_.faults.begin(), half}});
      propose("second half", Trial{trial_.run, {half, trial_.faults.end()}});
    }
    for (std::size_t i = count; i-- > 0;) {
      trial = trial_;
      trial.faults.erase(trial.faults.begin() + static_cast<std::ptrdiff_t>(i));
      propose("without " + std::to_string(i), trial);
    }
  }

  void fewer_uavs() {
    const std::size_t fleet = std::min(scenario_.fleet.size(), trial_.run.uavs.value_or(scenario_.fleet.size()));
    for (std::size_t count = 1; count < fleet; ++count) {
      std::set<std::string> gone;
      for (std::size_t i = count; i < scenario_.fleet.size(); ++i) gone.insert(scenario_.fleet[i].name);
      const bool all_there =
          std::ranges::none_of(trial_.faults, [&](const Fault& fault) { return names_any(fault, gone); });
      Trial trial = trial_;
      trial.run.uavs = count;
      if (all_there) propose("uavs " + std::to_string(count), std::move(trial));
    }
  }

  /// The mission never ends before the failure has been seen, or before the time that the property needs after the last
  /// fault.
  void shorter_mission() {
    double healed_s = 0.0;
    for (const Fault& fault : trial_.faults) healed_s = std::max(healed_s, fault.until_s.value_or(fault.at_s));
    const double least_s = std::max({kLeastMission_s, seen_s_ + kAfterSeen_s, after_s_ ? healed_s + *after_s_ : 0.0});
    propose_duration("shortest", 5.0 * std::ceil(least_s / 5.0), least_s);
    for (const double share : {0.5, 0.7, 0.85}) {
      propose_duration("share " + std::to_string(share), to_multiple(share * *trial_.run.duration_s, 5.0), least_s);
    }
  }
  void propose_duration(const std::string& what, double duration_s, double least_s) {
    if (duration_s < least_s || duration_s >= *trial_.run.duration_s) return;
    Trial trial = trial_;
    trial.run.duration_s = duration_s;
    std::erase_if(trial.faults, [&](const Fault& fault) { return fault.at_s >= duration_s; });
    for (Fault& fault : trial.faults) {
      if (fault.until_s) fault.until_s = std::min(*fault.until_s, duration_s);
    }
    propose(what, std::move(trial));
  }

  void plainer_run() {
    Trial trial = trial_;
    trial.run.seed = 0;
    propose("seed", trial);
    trial = trial_;
    trial.run.scene_seed.reset();
    propose("scene seed", trial);
    plainer_conditions();
    trial = trial_;
    trial.run.scenario = kSimplestScene;
    propose("scene", trial);
    trial = trial_;
    const bool one_for_all = trial.run.planner.find_first_of("=@") == std::string::npos ||
                             trial.run.planner.find(':') < trial.run.planner.find('=');
    const std::string name = trial.run.planner.substr(0, trial.run.planner.find(':'));
    const bool names_a_file = name == "exec" || name == "waypoints" || name == "py";  // it does not fly without
    if (one_for_all && !names_a_file) trial.run.planner = name;
    propose("parameters", trial);
  }

  /// The chosen conditions with one section off. Values of the scenario's own have no name, so the choice stays a text.
  std::string without_section(const std::string& chosen, const std::string& section) const {
    const ConditionsConfig now = chosen_conditions(chosen, scenario_.conditions);
    const std::string text = conditions_text(chosen_conditions(section + "=none", now));
    if (!has_word(text, "own")) return text;
    std::string parts = chosen, kept;
    std::ranges::replace(parts, '+', ',');
    for (const std::string& part : split(parts)) {
      if (!part.starts_with(section + "=")) kept += part + ",";
    }
    return kept + section + "=none";
  }

  /// No conditions, or none of one section.
  void plainer_conditions() {
    if (!trial_.run.conditions) return;
    propose_under("conditions", "none");
    for (const std::string& section : condition_sections()) {
      propose_under("conditions but " + section, without_section(*trial_.run.conditions, section));
    }
  }

  /// Replaces the condition of a waiting fault with the time at which the fault began.
  void without_waiting(std::size_t index) {
    Fault fault = trial_.faults[index];
    if (!fault.waits || index >= outcome_.began_s.size() || !outcome_.began_s[index]) return;
    const double begin_s = *outcome_.began_s[index];
    const double end_s = std::min(begin_s + fault.for_s.value_or(1e9), fault.until_s.value_or(1e9));
    fault.waits = false;
    fault.when.reset();
    fault.for_s.reset();
    fault.at_s = hundredths(begin_s);
    fault.until_s = hundredths(end_s);
    propose("at once", index, std::move(fault));
  }

  void shorter(std::size_t index) {
    const Fault& fault = trial_.faults[index];
    const double length_s = length_of_fault(fault);
    for (const double share : {0.25, 0.5}) {
      const double shorter_s = tenths(share * length_s);
      if (shorter_s >= kLeastLength_s) propose("shorter", index, with_times(fault, fault.at_s, shorter_s));
    }
  }

  void weaker(std::size_t index) {
    Fault fault = trial_.faults[index];
    if (auto* effect = std::get_if<LinkEffect>(&fault.action)) return weaker_link(index, fault, *effect);
    if (auto* jump = std::get_if<OdometryJump>(&fault.action)) {
      jump->offset_m *= 0.5;
      if (jump->offset_m.norm() > 0.2) propose("weaker", index, fault);
    } else if (auto* delay = std::get_if<CommandDelay>(&fault.action)) {
      delay->exchanges /= 2;
      if (delay->exchanges > 0) propose("weaker", index, fault);
    } else if (auto* motor = std::get_if<MotorFailure>(&fault.action)) {
      motor->thrust = hundredths(0.5 * (1.0 + motor->thrust));
      if (motor->thrust < 0.98) propose("weaker", index, fault);
    } else if (auto* gust = std::get_if<Gust>(&fault.action)) {
      for (double& part : gust->velocity_mps) part = tenths(0.5 * part);
      if (gust->velocity_mps.norm() > 0.5) propose("weaker", index, fault);
    } else if (auto* loss = std::get_if<BatteryLoss>(&fault.action)) {
      loss->charge = hundredths(0.5 * (1.0 + loss->charge));
      if (loss->charge < 0.98) propose("weaker", index, fault);
    }
  }
  /// Certain effects are simpler than random ones, because they depend on no draw.
  void weaker_link(std::size_t index, Fault fault, LinkEffect& effect) {
    const LinkEffect before = effect;
    if (effect.loss > 0.0 && effect.loss < 1.0) {
      effect.loss = 1.0;
      propose("certain loss", index, fault);
    }
    if (before.burst_loss) {
      effect = before;
      effect.burst_loss.reset();
      effect.loss = 1.0;
      propose("no bursts", index, fault);
    }
    effect = before;
    effect.latency_s = hundredths(0.5 * before.latency_s);
    effect.jitter_s = 0.0;
    if (effect.latency_s >= 0.05) propose("latency", index, fault);
    for (const bool source : {true, false}) {
      effect = before;
      (source ? effect.from : effect.to) = {"all"};
      propose(source ? "from all" : "to all", index, fault);
    }
  }

  void rounder(std::size_t index) {
    const Fault& fault = trial_.faults[index];
    const double length_s = length_of_fault(fault);
    for (const double step : {10.0, 5.0, 1.0}) {
      const double at_s = to_multiple(fault.at_s, step), rounder_s = std::max(step, to_multiple(length_s, step));
      const std::string what = "rounder " + std::to_string(step);
      if (is_in_time(at_s + rounder_s)) propose(what, index, with_times(fault, at_s, rounder_s));
      if (is_in_time(at_s + length_s)) propose(what + " at", index, with_times(fault, at_s, length_s));
    }
  }

  /// Whether a fault that ends then leaves enough mission time for the property.
  bool is_in_time(double end_s) const { return end_s + after_s_.value_or(0.0) <= *trial_.run.duration_s; }

  const Trial& trial_;
  const TrialOutcome& outcome_;
  const Scenario& scenario_;
  const std::optional<double> after_s_;
  double seen_s_ = 0.0;  ///< when the property failed
  std::vector<Proposal> proposals_;
};

}  // namespace

std::vector<Proposal> simpler(const Trial& trial, const TrialOutcome& outcome, const std::string& property,
                              const Scenario& scenario, std::optional<double> after_s) {
  return Proposals(trial, outcome, scenario, after_s).all(property);
}

Shrunk shrink(const Trial& trial, const TrialOutcome& outcome, const std::string& property, const Scenario& scenario,
              const ShrinkOptions& options, const FlyTrials& fly) {
  Shrunk best{trial, outcome};
  std::set<std::string> tried = {identity(trial)}, refused;
  for (bool smaller = true; smaller && best.flights < options.most;) {
    smaller = false;
    std::vector<Proposal> proposals = simpler(best.trial, best.outcome, property, scenario, options.after_s);
    std::erase_if(proposals, [&](const Proposal& one) {
      return refused.contains(one.what) || tried.contains(identity(one.trial));
    });
    for (std::size_t first = 0; first < proposals.size() && !smaller && best.flights < options.most;
         first += options.at_once) {
      std::vector<Trial> batch;
      for (std::size_t i = first; i < std::min(proposals.size(), first + options.at_once); ++i) {
        batch.push_back(proposals[i].trial);
      }
      const std::vector<TrialOutcome> outcomes = fly(batch);
      for (std::size_t i = 0; i < batch.size() && !smaller && best.flights < options.most; ++i) {  // as if singly
        ++best.flights;
        tried.insert(identity(batch[i]));
        if (!outcomes[i].fails(property)) {
          refused.insert(proposals[first + i].what);
          continue;
        }
        if (is_other_setting(best.trial, batch[i])) refused.clear();
        best.trial = batch[i];
        best.outcome = outcomes[i];
        smaller = true;
      }
    }
  }
  return best;
}

}  // namespace skein::cli
