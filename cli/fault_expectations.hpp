// What may be expected of a run with faults. One table (expectation_kinds) names every expectation, what it measures
// and what holds where a file says nothing; reading files, judging runs and docs/how-to-test-faults.md follow it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/run_record.hpp"
#include "core/config_reader.hpp"
#include "core/fault_plan.hpp"

namespace skein::cli {

/// One more run of the same test, which must have the same digest.
enum class Repeat { again, cyclonedds, fastdds, mixed, chaos };
constexpr std::array<EnumName<Repeat>, 5> enum_names(Repeat) {
  return {{{"again", Repeat::again},
           {"cyclonedds", Repeat::cyclonedds},
           {"fastdds", Repeat::fastdds},
           {"mixed", Repeat::mixed},
           {"chaos", Repeat::chaos}}};
}

/// What a judge looks at.
struct Evidence {
  const Scenario& scenario;
  const FaultPlan& plan;
  const RunRecord& run;
  int exit_code = 0;                                              ///< of `skein run`
  const RunRecord* fault_free = nullptr;                          ///< where an expectation asks for it
  std::vector<std::pair<std::string, const RunRecord*>> repeats;  ///< how they were flown, and what came of it
};

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
  /// What does not hold, one sentence each with what was expected and what was seen; empty when it holds.
  std::function<std::vector<std::string>(const Evidence&)> judge;
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

/// Sentences of the form "key: expected ..., seen ...", in the table's order; empty when everything holds.
std::vector<std::string> broken_expectations(const Expectations& expectations, const Evidence& evidence);

}  // namespace skein::cli
