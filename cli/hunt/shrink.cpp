#include "cli/hunt/shrink.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "cli/fault_tests/flights.hpp"
#include "cli/hunt/fault_maker.hpp"
#include "core/overloaded.hpp"

namespace skein::cli {
namespace {

constexpr double kLeastMission_s = 10.0, kLeastLength_s = 0.5;
constexpr const char* kSimplestScene = "towers";

double to_multiple(double value, double step) { return std::round(value / step) * step; }
double to_tenths(double value) { return std::round(10.0 * value) / 10.0; }
double to_hundredths(double value) { return std::round(100.0 * value) / 100.0; }

double length_of_fault(const Fault& fault) {
  return fault.waits ? fault.for_s.value_or(0.0) : fault.until_s.value_or(fault.at_s) - fault.at_s;
}
Fault with_times(Fault fault, double at_s, double length_s) {
  if (fault.waits) {
    fault.for_s = length_s;
  } else {
    fault.until_s = to_tenths(at_s + length_s);
  }
  fault.at_s = to_tenths(at_s);
  return fault;
}

/// Whether a fault, or what it waits for, names one of these.
bool names_any(const Fault& fault, const std::set<std::string>& of) {
  std::set<std::string> names;
  const auto add = [&names](const std::vector<std::string>& more) { names.insert(more.begin(), more.end()); };
  std::visit(Overloaded{[&](const LinkEffect& f) {
                          add(f.from);
                          add(f.to);
                        },
                        [&](const Partition& f) { std::ranges::for_each(f.groups, add); }, [](const StationOutage&) {},
                        [&](const Kill& f) { names.insert(f.member); }, [&](const Pause& f) { names.insert(f.member); },
                        [&](const auto& f) { names.insert(f.uav); }},
             fault.action);
  const std::string condition = fault.waits ? fault.when->text : "";
  return std::ranges::any_of(
      of, [&](const std::string& name) { return names.contains(name) || condition.find(name) != std::string::npos; });
}

class Proposals {
 public:
  Proposals(const Trial& trial, const TrialOutcome& outcome, const Scenario& scenario, double after_s)
      : trial_(trial), outcome_(outcome), scenario_(scenario), after_s_(after_s) {}

  std::vector<Trial> all(const std::string& property) {
    fewer_faults();
    fewer_uavs();
    shorter_mission(property);
    plainer_run();
    for (std::size_t i = 0; i < trial_.faults.size(); ++i) without_waiting(i);
    for (std::size_t i = 0; i < trial_.faults.size(); ++i) shorter(i);
    for (std::size_t i = 0; i < trial_.faults.size(); ++i) weaker(i);
    for (std::size_t i = 0; i < trial_.faults.size(); ++i) rounder(i);
    return std::move(trials_);
  }

 private:
  void propose(Trial trial) {
    if (trial.text() != trial_.text() || what_is_flown(trial.run) != what_is_flown(trial_.run)) {
      trials_.push_back(std::move(trial));
    }
  }
  void propose(std::size_t index, Fault fault) {
    Trial trial = trial_;
    trial.faults[index] = std::move(fault);
    propose(std::move(trial));
  }

  void fewer_faults() {
    const std::size_t count = trial_.faults.size();
    if (count > 1) propose(Trial{trial_.run, {}});
    if (count > 3) {
      const auto half = trial_.faults.begin() + static_cast<std::ptrdiff_t>(count / 2);
      propose(Trial{trial_.run, {trial_.faults.begin(), half}});
      propose(Trial{trial_.run, {half, trial_.faults.end()}});
    }
    for (std::size_t i = count; i-- > 0;) {
      Trial trial = trial_;
      trial.faults.erase(trial.faults.begin() + static_cast<std::ptrdiff_t>(i));
      propose(std::move(trial));
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
      if (all_there) propose(std::move(trial));
    }
  }

  /// As long as what came of it takes to be seen, and some more.
  void shorter_mission(const std::string& property) {
    const TrialFinding* finding = outcome_.find(property);
    const double duration_s = *trial_.run.duration_s;
    double healed_s = 0.0;
    for (const Fault& fault : trial_.faults) healed_s = std::max(healed_s, fault.until_s.value_or(0.0));
    const double seen_s = finding != nullptr ? finding->at_s : 0.0;
    const double least_s = std::max(kLeastMission_s, healed_s + after_s_);
    for (const double share : {0.5, 0.7, 0.85}) propose_duration(to_multiple(share * duration_s, 5.0), least_s);
    propose_duration(5.0 * std::ceil(std::max(seen_s + 5.0, least_s) / 5.0), least_s);
  }
  void propose_duration(double duration_s, double least_s) {
    if (duration_s < least_s || duration_s >= *trial_.run.duration_s) return;
    Trial trial = trial_;
    trial.run.duration_s = duration_s;
    propose(std::move(trial));
  }

  void plainer_run() {
    Trial trial = trial_;
    trial.run.seed = 0;
    propose(trial);
    trial = trial_;
    trial.run.scene_seed.reset();
    propose(trial);
    trial = trial_;
    trial.run.scenario = kSimplestScene;
    propose(trial);
    trial = trial_;
    const bool one_for_all = trial.run.planner.find_first_of("=@") == std::string::npos ||
                             trial.run.planner.find(':') < trial.run.planner.find('=');
    if (one_for_all) trial.run.planner = trial.run.planner.substr(0, trial.run.planner.find(':'));
    propose(trial);
  }

  /// At the time at which it began, if it waited for something.
  void without_waiting(std::size_t index) {
    Fault fault = trial_.faults[index];
    if (!fault.waits || index >= outcome_.began_s.size() || !outcome_.began_s[index]) return;
    const double begin_s = *outcome_.began_s[index];
    const double end_s = std::min(begin_s + fault.for_s.value_or(1e9), fault.until_s.value_or(1e9));
    fault.waits = false;
    fault.when.reset();
    fault.for_s.reset();
    fault.at_s = to_hundredths(begin_s);
    fault.until_s = to_hundredths(end_s);
    propose(index, std::move(fault));
  }

  void shorter(std::size_t index) {
    const Fault& fault = trial_.faults[index];
    const double length_s = length_of_fault(fault);
    for (const double share : {0.25, 0.5}) {
      const double shorter_s = to_tenths(share * length_s);
      if (shorter_s >= kLeastLength_s) propose(index, with_times(fault, fault.at_s, shorter_s));
    }
  }

  void weaker(std::size_t index) {
    Fault fault = trial_.faults[index];
    if (auto* effect = std::get_if<LinkEffect>(&fault.action)) return weaker_link(index, fault, *effect);
    if (auto* jump = std::get_if<OdometryJump>(&fault.action)) {
      jump->offset_m *= 0.5;
      if (jump->offset_m.norm() > 0.2) propose(index, fault);
    } else if (auto* delay = std::get_if<CommandDelay>(&fault.action)) {
      delay->exchanges /= 2;
      if (delay->exchanges > 0) propose(index, fault);
    } else if (auto* motor = std::get_if<MotorFailure>(&fault.action)) {
      motor->thrust = to_hundredths(0.5 * (1.0 + motor->thrust));
      if (motor->thrust < 0.98) propose(index, fault);
    }
  }
  /// Of random effects certain ones are simpler: they hang on no draw.
  void weaker_link(std::size_t index, Fault fault, LinkEffect& effect) {
    const LinkEffect before = effect;
    if (effect.loss > 0.0 && effect.loss < 1.0) {
      effect.loss = 1.0;
      propose(index, fault);
    }
    if (before.burst_loss) {
      effect = before;
      effect.burst_loss.reset();
      effect.loss = 1.0;
      propose(index, fault);
    }
    effect = before;
    effect.latency_s = to_hundredths(0.5 * before.latency_s);
    effect.jitter_s = 0.0;
    if (effect.latency_s >= 0.05) propose(index, fault);
    for (const bool source : {true, false}) {
      effect = before;
      (source ? effect.from : effect.to) = {"all"};
      propose(index, fault);
    }
  }

  void rounder(std::size_t index) {
    const Fault& fault = trial_.faults[index];
    const double length_s = length_of_fault(fault);
    for (const double step : {10.0, 5.0, 1.0}) {
      const double at_s = to_multiple(fault.at_s, step), rounder_s = std::max(step, to_multiple(length_s, step));
      if (at_s + rounder_s < *trial_.run.duration_s) propose(index, with_times(fault, at_s, rounder_s));
      if (at_s + length_s < *trial_.run.duration_s) propose(index, with_times(fault, at_s, length_s));
    }
  }

  const Trial& trial_;
  const TrialOutcome& outcome_;
  const Scenario& scenario_;
  const double after_s_;
  std::vector<Trial> trials_;
};

std::string identity(const Trial& trial) { return what_is_flown(trial.run) + trial.text(); }

}  // namespace

std::vector<Trial> simpler(const Trial& trial, const TrialOutcome& outcome, const std::string& property,
                           const Scenario& scenario, double after_s) {
  std::vector<Trial> trials = Proposals(trial, outcome, scenario, after_s).all(property);
  for (Trial& one : trials) one.faults = without_contradictions(std::move(one.faults));
  return trials;
}

Shrunk shrink(const Trial& trial, const TrialOutcome& outcome, const std::string& property, const Scenario& scenario,
              const ShrinkOptions& options, const FlyTrials& fly) {
  Shrunk best{trial, outcome};
  std::set<std::string> tried = {identity(trial)};
  for (bool smaller = true; smaller && best.flights < options.most;) {
    smaller = false;
    std::vector<Trial> proposals = simpler(best.trial, best.outcome, property, scenario, options.after_s);
    std::erase_if(proposals, [&](const Trial& one) { return tried.contains(identity(one)); });
    for (std::size_t first = 0; first < proposals.size() && !smaller && best.flights < options.most;
         first += options.at_once) {
      const std::size_t last = std::min(proposals.size(), first + options.at_once);
      const std::vector<Trial> batch(proposals.begin() + static_cast<std::ptrdiff_t>(first),
                                     proposals.begin() + static_cast<std::ptrdiff_t>(last));
      const std::vector<TrialOutcome> outcomes = fly(batch);
      for (std::size_t i = 0; i < batch.size() && !smaller && best.flights < options.most; ++i) {  // as one by one
        ++best.flights;
        tried.insert(identity(batch[i]));
        if (!outcomes[i].fails(property)) continue;
        best.trial = batch[i];
        best.outcome = outcomes[i];
        smaller = true;
      }
    }
  }
  return best;
}

}  // namespace skein::cli
