// What may be expected of a run with faults. One table (expectation_kinds) names every expectation, what it measures
// and what holds where a file says nothing; reading files, judging runs and docs/how-to-test-faults.md follow it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/fault_tests/judges.hpp"
#include "core/config/config_reader.hpp"
#include "core/faults/fault_plan.hpp"

namespace skein::cli {

/// What makes sense in a file depends on the scenario and the faults.
struct ExpectationContext {
  const Scenario& scenario;
  const FaultPlan& plan;
  ConfigErrors& errors;
};

/// One line of a file's `expect`, read.
struct Expectation {
  std::string key;
  bool needs_fault_free = false;
  std::vector<Repeat> repeats;
  std::function<void(const ExpectationContext&)> check;  ///< adds errors where names do not exist
  /// At least one finding, unless there was nothing to look at.
  std::function<Findings(const Evidence&)> judge;
};

/// A kind of expectation.
struct ExpectationKind {
  std::string key, meaning;
  std::string usual;  ///< what is expected where a file does not say, as files spell it; empty: nothing
  std::function<std::optional<Expectation>(ConfigReader&)> read;
};

const std::vector<ExpectationKind>& expectation_kinds();

/// A file's `expect`.
struct Expectations {
  std::vector<Expectation> all;

  template <class R>
  void describe(R& r) {
    for (const ExpectationKind& kind : expectation_kinds()) {
      if (auto expectation = kind.read(r)) all.push_back(std::move(*expectation));
    }
  }
};

struct Judgement {
  std::string key;  ///< of the expectation
  Finding finding;

  /// Of its place in the file.
  std::string path() const { return "expect." + key + finding.part; }
};

/// What became of each expectation, in the table's order.
std::vector<Judgement> judged(const Expectations& expectations, const Evidence& evidence);

}  // namespace skein::cli
