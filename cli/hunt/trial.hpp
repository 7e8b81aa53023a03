// One flight of a hunt: the run, its faults, and its outcome.
// Reads the flight's folder. Times in simulated seconds.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/fault_tests/fault_test.hpp"
#include "core/faults/fault_plan.hpp"
#include "core/scenario/scenario.hpp"
#include "host/program_host.hpp"
#include "process/json_text.hpp"
#include "run/run_options.hpp"
#include "signals/properties/evaluation.hpp"
#include "signals/properties/property_file.hpp"

namespace skein::cli {

struct Trial {
  RunOptions run;  ///< without faults and folder
  std::vector<Fault> faults;

  /// The faults as the text of a fault file. The same `run` with the same text is the same flight.
  std::string text() const;
};

/// The result of one property in a trial.
struct TrialFinding {
  std::string property;
  properties::Verdict::Outcome outcome = properties::Verdict::Outcome::vacuous;
  std::optional<double> margin;  ///< in SI units; nullopt: vacuous, or true or false without a measure
  double at_s = 0.0;             ///< when it was decided
  std::string text;              ///< for people

  bool fails() const { return outcome == properties::Verdict::Outcome::fails; }
};

struct TrialOutcome {
  std::string digest = {};                          ///< empty: none
  double score = 0.0, end_s = 0.0;                  ///< score that was delivered; simulated time at the end of the run
  std::vector<TrialFinding> findings = {};          ///< kCompletes, then the properties in their order
  std::vector<std::optional<double>> began_s = {};  ///< by fault: when it began; nullopt: never
  std::vector<std::uint64_t> states = {};           ///< states of the fleet, see states_of(); ascending

  const TrialFinding* find(const std::string& property) const;
  bool fails(const std::string& property) const;
  Json to_json() const;
  /// @returns nullopt if the JSON is not an outcome.
  static std::optional<TrialOutcome> from_json(const Json& json);
};

/// The properties to evaluate in a run with these faults: all except those whose `not_with` names one of the faults.
properties::PropertySet asked_of(const std::vector<Fault>& faults, const properties::PropertySet& set);

/// Reads the outcome of a trial from its folder. If kCompletes fails, it is the only finding.
/// @param undisturbed  folder of the same run without faults, if a property compares with it.
/// @throws std::runtime_error if a table of the run is damaged; InputError if the run lacks a signal of a property.
TrialOutcome read_outcome(const std::filesystem::path& dir, const ExitStatus& exit, const Trial& trial,
                          const properties::PropertySet& set, const Scenario& scenario,
                          const std::optional<std::filesystem::path>& undisturbed);

/// Hashes of the states of the fleet, sampled every 0.5 s; each once, ascending. A state consists of the programs that
/// took part, the kinds of active faults, the groups of nodes that links connect, the quarter of the mission, and
/// whether the UAVs held none, few or many captures. New states are the measure of the search's coverage.
std::vector<std::uint64_t> states_of(properties::RunSignals& signals, const Scenario& scenario,
                                     const std::vector<Fault>& faults, const TrialOutcome& outcome);

}  // namespace skein::cli
