// Which case a hunt flies next: a drawn one, or one like a former one that came near to breaking a property or got into
// a new state. What case N is depends on the seed and on what came of the cases up to N - lag, and on nothing else:
// not on how many fly at once, nor on which was over first. Pure. One thread.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "cli/hunt/fault_maker.hpp"
#include "cli/hunt/trial.hpp"

namespace skein::cli {

struct HuntCase {
  std::uint64_t seed = 0;  ///< of the run
  std::vector<Fault> faults;
  std::string conditions = {};  ///< empty: the scenario's own
};

class HuntSearch {
 public:
  /// The usual lag: so many cases may be in the air or not yet looked at.
  static constexpr std::size_t kLag = 16;
  /// Runs have one of so many seeds, from 1 on.
  static constexpr std::uint64_t kRunSeeds = 4;

  /// @param conditions  what cases are flown under; empty: the scenario's own
  HuntSearch(FaultMaker maker, std::uint64_t seed, std::size_t lag = kLag, std::vector<std::string> conditions = {})
      : maker_(std::move(maker)), seed_(seed), lag_(lag), conditions_(std::move(conditions)) {}

  /// The next case; the first one has no faults, and the first of the conditions.
  /// @param before  what came of the cases in their order: at least up to the one `lag` before this one. What is
  ///   behind that one is not looked at.
  const HuntCase& next(const std::vector<std::optional<TrialOutcome>>& before);
  /// Whether enough is known for the next one.
  bool may_go_on(const std::vector<std::optional<TrialOutcome>>& before) const;
  const std::vector<HuntCase>& cases() const { return cases_; }

 private:
  void learn(std::size_t index, const TrialOutcome& outcome);
  const HuntCase& parent(RandomStream& draw) const;

  const FaultMaker maker_;
  const std::uint64_t seed_;
  const std::size_t lag_;
  const std::vector<std::string> conditions_;
  std::vector<HuntCase> cases_;
  std::size_t learnt_ = 0;  ///< cases
  std::set<std::uint64_t> states_;
  std::vector<std::size_t> discoverers_;  ///< cases that met a new state
  struct Nearest {
    double margin = 0.0;
    std::size_t index = 0;
  };
  std::map<std::string, Nearest> nearest_;  ///< by property: the case that came nearest to breaking it
};

}  // namespace skein::cli
