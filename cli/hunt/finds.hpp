// What a hunt found: which failures it goes into, each made small and flown over DDS, with its capsule.
// Threads: one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/hunt/flights.hpp"
#include "cli/hunt/search.hpp"
#include "cli/hunt/shrink.hpp"

namespace skein::cli {

struct Find {
  std::string name;       ///< "separation-17": property and case
  std::string broke;      ///< the property that failed in the search
  std::string property;   ///< the same; kSameDigest where the run over DDS was another one
  std::size_t index = 0;  ///< of the case
  Trial trial;            ///< made small
  std::string told;       ///< what was seen, for people
  std::string digest;
  std::filesystem::path capsule;
  std::filesystem::path run;  ///< its results folder
  std::size_t flights = 0;    ///< that it took to make it small
  double wall_s = 0.0;
  bool over_dds = false;  ///< it was flown over DDS, too, and was the same

  /// All but the trial, which the capsule has.
  Json to_json() const;
};

/// A case in which a property failed.
struct Failure {
  std::size_t index = 0;
  std::string property;
};

/// Those among the first `count` cases, by case. A run that does not come to its end is one failure.
std::vector<Failure> failures_of(const std::vector<std::optional<TrialOutcome>>& outcomes, std::size_t count);

class Finds {
 public:
  /// Of one property, at most so many are gone into.
  static constexpr std::size_t kMostOfAProperty = 3;

  Finds(const HuntPlan& plan, TrialFlights& flights, const Console& console)
      : plan_(plan), flights_(flights), console_(console) {}

  /// Makes a find of a failure, unless it has all faults of a find of the same property: then it is taken for the same.
  /// What was made small before, of the same case with the same options, is not flown again.
  void go_into(const Failure& failure, const Trial& trial, const TrialOutcome& outcome);

  const std::vector<Find>& all() const { return finds_; }
  /// Failures by property, gone into or not.
  const std::map<std::string, std::size_t>& counts() const { return counts_; }

 private:
  bool is_known(const Failure& failure, const Trial& trial) const;
  std::optional<Find> made_before(const Find& find, const std::string& of) const;
  void make_small(Find& find, const Trial& trial, const TrialOutcome& outcome);
  void confirm(Find& find, const TrialOutcome& outcome);
  void write(const Find& find, const std::string& of) const;

  const HuntPlan& plan_;
  TrialFlights& flights_;
  const Console& console_;
  std::vector<Find> finds_;
  std::map<std::string, std::size_t> counts_;
};

}  // namespace skein::cli
