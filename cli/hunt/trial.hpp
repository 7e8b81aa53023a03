// One flight of a hunt: what is flown and what goes wrong in it; and what came of it.
// Reads the flight's folder.   Simulated seconds.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/fault_tests/fault_test.hpp"
#include "cli/host/program_host.hpp"
#include "core/faults/fault_plan.hpp"
#include "core/scenario.hpp"
#include "process/json_text.hpp"
#include "properties/evaluation.hpp"
#include "properties/property_file.hpp"

namespace skein::cli {

struct Trial {
  RunOptions run;  ///< without faults and folder
  std::vector<Fault> faults;

  /// A fault file. The same text is the same flight.
  std::string text() const;
};

/// What became of one property in a trial.
struct TrialFinding {
  std::string property;
  properties::Verdict::Outcome outcome = properties::Verdict::Outcome::vacuous;
  std::optional<double> margin;  ///< in SI; none: it is true or false by itself
  double at_s = 0.0;             ///< when it was decided
  std::string text;              ///< for people

  bool fails() const { return outcome == properties::Verdict::Outcome::fails; }
};

struct TrialOutcome {
  std::string digest = {};                          ///< empty: none
  double score = 0.0, end_s = 0.0;                  ///< delivered; simulated time of the run
  std::vector<TrialFinding> findings = {};          ///< kCompletes, then the properties in their order
  std::vector<std::optional<double>> began_s = {};  ///< by fault: when it began
  std::vector<std::uint64_t> states = {};           ///< what the fleet was in, see states_of(); ascending

  const TrialFinding* find(const std::string& property) const;
  bool fails(const std::string& property) const;
  Json to_json() const;
  /// @returns nullopt for what is no such thing.
  static std::optional<TrialOutcome> from_json(const Json& json);
};

/// The properties that are asked of a run with these faults: not those that say nothing with one of them.
properties::PropertySet asked_of(const std::vector<Fault>& faults, const properties::PropertySet& set);

/// @param undisturbed  folder of the same run without faults, where a property compares with it.
TrialOutcome read_outcome(const std::filesystem::path& dir, const ExitStatus& exit, const Trial& trial,
                          const properties::PropertySet& set, const Scenario& scenario,
                          const std::optional<std::filesystem::path>& undisturbed);

/// What the fleet was in, exchange by exchange, as hashes, each once, ascending: who took part, which kinds of faults
/// were in force, which nodes had links to each other, how far the mission was, and how much was undelivered. A search
/// that meets new ones gets about.
std::vector<std::uint64_t> states_of(properties::RunSignals& signals, const Scenario& scenario,
                                     const std::vector<Fault>& faults, const TrialOutcome& outcome);

}  // namespace skein::cli
