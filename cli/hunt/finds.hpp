// Turns failures of a hunt into finds: minimises them, confirms them over DDS, and writes their capsules.
// Threads: one, that of the flights.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/hunt/flights.hpp"
#include "cli/hunt/search.hpp"
#include "cli/hunt/shrink.hpp"

namespace skein::cli {

struct Find {
  std::string name;       ///< property and case: "separation-17"
  std::string broke;      ///< the property that failed in the search
  std::string property;   ///< as `broke`; kSameDigest if the run over DDS differs
  std::size_t index = 0;  ///< number of the case
  Trial trial;            ///< after minimising
  std::string told;       ///< what failed, for people
  std::string digest;
  std::filesystem::path capsule;
  std::filesystem::path run;  ///< results folder of the minimised trial
  std::size_t flights = 0;    ///< flights that minimising took
  double wall_s = 0.0;        ///< wall time of minimising and confirming [s]
  bool over_dds = false;      ///< the run in one process has been repeated over DDS, with the same digest and failure

  /// The figures of the find. Its trial is in the capsule.
  Json to_json() const;
};

/// A case in which a property failed.
struct Failure {
  std::size_t index = 0;
  std::string property;
};

/// The failures in the first `count` cases, in the order of the cases. For a run that does not go to its end, this is
/// only the failure of kCompletes.
std::vector<Failure> failures_of(const std::vector<std::optional<TrialOutcome>>& outcomes, std::size_t count);

class Finds {
 public:
  /// Largest number of finds of one property; further failures of it are only counted.
  static constexpr std::size_t kMostOfAProperty = 3;

  Finds(const HuntPlan& plan, TrialFlights& flights, const Console& console)
      : plan_(plan), flights_(flights), console_(console) {}

  /// Makes a find of a failure, unless its faults include all kinds of faults of a known find of the same property:
  /// then both count as the same. Reuses a find that an interrupted call of the same hunt has written.
  /// @throws Interrupted
  void go_into(const Failure& failure, const Trial& trial, const TrialOutcome& outcome);

  const std::vector<Find>& all() const { return finds_; }
  /// Number of failures by property, with or without a find.
  const std::map<std::string, std::size_t>& counts() const { return counts_; }

 private:
  bool is_known(const Failure& failure, const Trial& trial) const;
  std::optional<Find> made_before(const Find& find, const std::string& of) const;
  void make_small(Find& find, const Trial& trial, const TrialOutcome& outcome);
  void confirm(Find& find, const TrialOutcome& outcome);
  void write(const Find& find, const std::string& of) const;

  const HuntPlan& plan_;
  TrialFlights& flights_;
  const Console console_;
  std::vector<Find> finds_;
  std::map<std::string, std::size_t> counts_;
};

}  // namespace skein::cli
