// Chooses the next case of a hunt: a random one, or a variation of an earlier case that came near to breaking a
// property or met a new state of the fleet. Case N depends only on the seed and the outcomes of the cases up to
// N - lag, not on how many cases fly at once or which ends first. Pure. One thread.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "cli/hunt/fault_maker.hpp"
#include "cli/hunt/trial.hpp"
#include "cli/hunt_options.hpp"

namespace skein::cli {

struct HuntCase {
  std::uint64_t seed = 0;  ///< seed of the run
  std::vector<Fault> faults;
  std::string conditions = {};  ///< empty: the scenario's own
};

class HuntSearch {
 public:
  /// The usual lag: at most this many cases are fixed whose outcomes are not known yet.
  static constexpr std::size_t kLag = kUsualRound;
  static constexpr std::size_t kMostLag = kMostRound;
  /// Runs have seeds from 1 to this number.
  static constexpr std::uint64_t kRunSeeds = 4;

  /// @param conditions  each case is flown under one of these; empty: the scenario's own
  HuntSearch(FaultMaker maker, std::uint64_t seed, std::size_t lag = kLag, std::vector<std::string> conditions = {})
      : maker_(std::move(maker)), seed_(seed), lag_(lag), conditions_(std::move(conditions)) {}

  /// Makes the next case. The first case has no faults, and the first of the conditions. The reference is valid until
  /// the next call.
  /// @param before  outcomes by number of the case, at least up to the case `lag` before this one; ignores later ones
  const HuntCase& next(const std::vector<std::optional<TrialOutcome>>& before);
  /// Whether `before` has the outcomes that next() needs.
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
  std::size_t learnt_ = 0;  ///< number of cases whose outcomes have been evaluated
  std::set<std::uint64_t> states_;
  std::vector<std::size_t> discoverers_;  ///< cases that met a new state of the fleet
  struct Nearest {
    double margin = 0.0;
    std::size_t index = 0;
  };
  std::map<std::string, Nearest> nearest_;  ///< by property: the case that held with the least margin
};

}  // namespace skein::cli
