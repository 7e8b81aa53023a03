#include "cli/hunt/flights.hpp"

#include <deque>
#include <numeric>
#include <system_error>

#include "cli/fault_tests/flights.hpp"
#include "cli/study/side_by_side.hpp"
#include "host/preflight.hpp"
#include "process/files/atomic_file.hpp"
#include "process/program.hpp"
#include "run/drawn_world.hpp"
#include "run/results_dir.hpp"
#include "run/run_options.hpp"
#include "signals/judge.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFaultFile = "faults.yaml";
constexpr const char* kFlightsFolder = "flights";

void remove_folder(const fs::path& dir) {
  std::error_code ignored;
  fs::remove_all(dir, ignored);
}

}  // namespace

std::string TrialFlights::name_of_trial(std::size_t index) { return "case-" + std::to_string(index); }

fs::path TrialFlights::dir_of(const std::string& name) const { return fs::absolute(plan_.out) / kFlightsFolder / name; }

const TrialFlights::Setting* TrialFlights::setting_of(const Trial& trial) {
  const auto [found, is_new] = settings_.try_emplace(what_is_flown(trial.run));
  if (is_new) {
    try {
      Scenario scenario = scenario_flown(trial.run);
      properties::PropertySet set = properties::parse_properties(plan_.entries, scenario);
      found->second.emplace(Setting{std::move(scenario), std::move(set)});
    } catch (const InputError&) {
      found->second.reset();
    }
  }
  return found->second ? &*found->second : nullptr;
}

ProgramSpec TrialFlights::start(const Trial& trial, const fs::path& dir) const {
  remove_folder(dir);
  if (const std::error_code error = make_results_folder(dir)) throw std::system_error(error, dir);
  RunOptions run = trial.run;
  run.out = dir;
  if (!trial.faults.empty()) {
    run.faults = dir / kFaultFile;
    write_file_atomically(*run.faults, trial.text());
  }
  return flight_program(run);
}

properties::PropertySet TrialFlights::asked(const properties::PropertySet& set) const {
  properties::PropertySet some = set;
  if (!asked_.empty()) std::erase_if(some, [this](const auto& property) { return property.name != asked_; });
  return some;
}

TrialOutcome TrialFlights::read(const Trial& trial, const fs::path& dir, const ExitStatus& exit) {
  ++flown_;
  const Setting* const setting = setting_of(trial);
  if (setting == nullptr || exit.code == kExitBadInput) return {};
  const auto undisturbed = undisturbed_.find(what_is_flown(trial.run));
  return read_outcome(dir, exit, trial, asked(setting->set), setting->scenario,
                      undisturbed == undisturbed_.end() ? std::nullopt : std::optional(undisturbed->second));
}

void TrialFlights::fly(const std::vector<std::size_t>& numbers, const Make& make, const Over& over) {
  std::map<std::size_t, Trial> running;
  SideBySide side_by_side(static_cast<std::size_t>(*plan_.options.jobs), console_);
  const auto start_one = [&](std::size_t index) -> std::optional<ProgramSpec> {
    std::optional<Trial> trial = make(index);
    if (!trial) return std::nullopt;
    const fs::path dir = dir_of(name_of_trial(index));
    ProgramSpec spec = start(*trial, dir);
    running.emplace(index, std::move(*trial));
    return spec;
  };
  const auto end_one = [&](std::size_t index, const ExitStatus& exit) {
    const Trial trial = running.extract(index).mapped();
    const fs::path dir = dir_of(name_of_trial(index));
    TrialOutcome outcome = read(trial, dir, exit);
    remove_folder(dir);
    over(index, std::move(outcome));
  };
  if (!side_by_side.fly({numbers.begin(), numbers.end()}, start_one, end_one)) throw Interrupted{};
}

void TrialFlights::fly_undisturbed(const std::vector<Trial>& trials) {
  std::vector<Trial> missing;
  std::vector<fs::path> dirs;
  for (const Trial& trial : trials) {
    const Setting* setting = setting_of(trial);
    if (setting == nullptr || !signals::needs_undisturbed(asked(setting->set))) continue;
    const fs::path dir = dir_of("without-faults-" + std::to_string(undisturbed_.size() + 1));
    if (!undisturbed_.emplace(what_is_flown(trial.run), dir).second) continue;
    missing.push_back({trial.run, {}});
    dirs.push_back(dir);
  }
  if (missing.empty()) return;
  std::deque<std::size_t> waiting(missing.size());
  std::iota(waiting.begin(), waiting.end(), std::size_t{0});
  SideBySide side_by_side(static_cast<std::size_t>(*plan_.options.jobs), console_);
  const bool all = side_by_side.fly(
      std::move(waiting), [&](std::size_t index) { return start(missing[index], dirs[index]); },
      [](std::size_t, const ExitStatus&) {});
  if (!all) throw Interrupted{};
}

std::vector<TrialOutcome> TrialFlights::fly(const std::vector<Trial>& trials) {
  std::vector<TrialOutcome> outcomes(trials.size());
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    if (setting_of(trials[i]) != nullptr) numbers.push_back(i);
  }
  fly_undisturbed(trials);
  fly(
      numbers, [&](std::size_t index) { return trials[index]; },
      [&](std::size_t index, TrialOutcome outcome) { outcomes[index] = std::move(outcome); });
  return outcomes;
}

TrialOutcome TrialFlights::fly_and_keep(const Trial& trial) {
  fly_undisturbed({trial});
  if (setting_of(trial) == nullptr) return {};
  TrialOutcome outcome;
  SideBySide side_by_side(1, console_);
  const bool flown = side_by_side.fly(
      {0}, [&](std::size_t) { return start(trial, *trial.run.out); },
      [&](std::size_t, const ExitStatus& exit) { outcome = read(trial, *trial.run.out, exit); });
  if (!flown) throw Interrupted{};
  return outcome;
}

}  // namespace skein::cli
