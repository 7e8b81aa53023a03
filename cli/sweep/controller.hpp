// Decides what of a sweep is given to the engine, until all is flown, checked and agreed upon. It keeps nothing in its
// memory that the folder does not hold: it may be killed at any moment, and another one goes on.
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

/// What is to be flown, and in which pieces.
struct SweepPlan {
  std::size_t flights = 0;
  std::function<SweepFlight(std::size_t index)> flight;
  std::vector<SweepFlight> references;  ///< the first of them that goes well is the reference flight
  /// The division into units, if the reference flight takes so long [s].
  std::function<UnitSizes(double reference_s)> unit_sizes;
  std::vector<std::string> command;  ///< as in SweepSettings, like the next one
  std::filesystem::path working_folder;
};

/// One flight in so many is flown again on another node.
inline constexpr std::size_t kCheckedShare = 100;

/// Whether this one is; of a sweep with few flights one is at least.
bool is_checked(std::size_t index, std::size_t flights);

class SweepController {
 public:
  /// @param here  this machine: it flies the reference flight, and judges between two nodes that differ.
  SweepController(SweepFolder& folder, SweepEngine& engine, const SweepNode& here, std::ostream& say)
      : folder_(folder), engine_(engine), here_(here), say_(say) {}

  /// Begins the sweep, or goes on with it where it is the same.
  /// @param anew  the user asked: what failed before gets all its tries again
  void plan(const SweepPlan& plan, bool anew = true);
  /// Of a sweep that is there, to be looked at. @throws InputError when there is none.
  void look();
  /// @returns false when it was interrupted, or nobody waits for the engine.
  bool fly();

  /// Calls `take` with what came of each flight that is over, in no order that means anything.
  void collect(const std::function<void(SweepRow row)>& take) const;

  const SweepSettings& settings() const { return settings_; }
  /// Units that are not over, each with the last words of its log.
  std::map<std::size_t, std::string> failed() const;
  /// What is known of nodes and of flights that were flown again, for people, a line each.
  std::vector<std::string> findings() const;

 private:
  void begin(const SweepPlan& plan, const std::string& digest_of_plan);
  void fly_a_reference(const SweepPlan& plan);
  void close_what_is_flown(std::size_t unit) const;
  void reopen_what_must_fly(const SweepPlan& plan) const;
  std::set<std::string> nodes_to_avoid() const;
  std::vector<std::size_t> open_units() const;
  std::vector<std::size_t> within_tries(const std::vector<std::size_t>& units) const;
  std::vector<SweepFlight> unchecked_flights() const;
  std::vector<std::size_t> units_of_checks() const;
  std::set<std::string> nodes_of_no_use(const std::vector<std::size_t>& checks,
                                        const std::set<std::string>& avoided) const;
  EngineWork checks_elsewhere();
  bool check_here();
  void judge(const SweepCheck& check) const;
  void judge_checks() const;
  void remove_quarantined();
  SweepFlight flight(std::size_t index) const;
  void tell_progress();

  SweepFolder& folder_;
  SweepEngine& engine_;
  const SweepNode& here_;
  std::ostream& say_;
  SweepSettings settings_;
  std::set<std::string> removed_;  ///< nodes in quarantine, of which nothing is there any more
  std::size_t checked_here_ = 0;   ///< flights
  std::size_t told_ = 0;           ///< units that were over when progress was told last
};

}  // namespace skein::cli
