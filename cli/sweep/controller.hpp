// The controller of a sweep decides which units the engine gets, until all flights have been flown and a sample of them
// has been checked on a second node. Its state is in the sweep's folder: if it is killed, another controller continues.
// Reads and writes the sweep's folder. One thread.
#pragma once

#include <functional>
#include <iosfwd>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "cli/sweep/engine.hpp"
#include "cli/sweep/folder.hpp"
#include "cli/sweep/unit_run.hpp"

namespace skein::cli {

/// The flights of a sweep, and their division into units.
struct SweepPlan {
  std::size_t flights = 0;
  std::function<SweepFlight(std::size_t index)> flight;
  std::vector<SweepFlight> references;  ///< candidates: the first one that succeeds is the reference flight
  /// Divides the flights into units. @param reference_s  wall time of the reference flight [s]
  std::function<UnitSizes(double reference_s)> unit_sizes;
  std::vector<std::string> command;  ///< as in SweepSettings, like `working_folder`
  std::filesystem::path working_folder;
};

/// One flight in this many is flown again on another node, as a check.
inline constexpr std::size_t kCheckedShare = 100;

/// Whether flight `index` is checked. In a sweep of fewer than kCheckedShare flights, exactly one flight is.
bool is_checked(std::size_t index, std::size_t flights);

class SweepController {
 public:
  /// @param here  this machine: flies the reference flight. If the digests of two nodes differ, its digest decides.
  SweepController(SweepFolder& folder, SweepEngine& engine, const SweepNode& here, std::ostream& say)
      : folder_(folder), engine_(engine), here_(here), say_(say) {}

  /// Begins the sweep; if the folder already holds the same one, continues it: reads the results of finished units
  /// again, and opens the units that have lost one.
  /// @param anew  the user started this: failed units get all their tries again
  void plan(const SweepPlan& plan, bool anew = true);
  /// Reads the settings of an existing sweep, to report on it. @throws InputError if the folder holds none.
  void look();
  /// Flies and checks until nothing is left to do. @returns false if the user interrupted it, or does not want to wait
  /// for the engine (--detach).
  bool fly();

  /// Flights of finished units whose results are missing or damaged, by index, each with what is wrong. Reads the
  /// results of all finished units.
  std::map<std::size_t, std::string> lost() const;
  /// Calls `take` with the result of each flight that is over, in no particular order. Takes the flights of finished
  /// units from the units' records, without reading their results again.
  void collect(const std::function<void(SweepRow row)>& take) const;

  const SweepSettings& settings() const { return settings_; }
  /// The units that are not over, by number, each with the last line of its log (empty: none).
  std::map<std::size_t, std::string> failed() const;
  /// Lines for the user about quarantined nodes, and about the flights that were checked.
  std::vector<std::string> findings() const;

 private:
  std::string text_of_checks() const;
  void begin(const SweepPlan& plan, const std::string& digest_of_plan);
  void fly_a_reference(const SweepPlan& plan);
  SweepUnit planned_unit(const SweepPlan& plan, std::size_t number) const;
  void close_what_is_flown(std::size_t unit, std::ostream* say) const;
  void mend_units(const SweepPlan& plan) const;
  void reopen_what_must_fly(bool failed_too) const;
  std::set<std::string> nodes_to_avoid() const;
  std::vector<std::size_t> open_units() const;
  std::vector<std::size_t> within_tries(const std::vector<std::size_t>& units) const;
  std::vector<SweepFlight> unchecked_flights() const;
  std::vector<std::size_t> units_of_checks() const;
  std::set<std::string> nodes_of_no_use(const std::vector<std::size_t>& checks,
                                        const std::set<std::string>& avoided) const;
  EngineWork checks_elsewhere();
  std::optional<std::string> flown_again(const SweepFlight& flight);
  bool check_here();
  void judge(const SweepCheck& check);
  void judge_checks();
  void remove_quarantined();
  SweepFlight flight(std::size_t index) const;
  void tell_progress();

  SweepFolder& folder_;
  SweepEngine& engine_;
  const SweepNode& here_;
  std::ostream& say_;
  SweepSettings settings_;
  std::set<std::string> removed_;     ///< quarantined nodes whose results have been set aside
  std::size_t checked_here_ = 0;      ///< number of checks that this machine has flown
  std::set<std::size_t> fails_here_;  ///< flights that failed when this machine flew them again
  std::size_t told_ = 0;              ///< units that were over at the last report of progress
};

}  // namespace skein::cli
