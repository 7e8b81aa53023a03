// The flights of a hunt: each is a `skein run` in its own folder, which is deleted once its outcome has been read.
// Threads: one, which must live as long as the flights.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/console.hpp"
#include "cli/hunt/plan.hpp"
#include "cli/hunt/trial.hpp"

namespace skein::cli {

class TrialFlights {
 public:
  /// Makes the trial with this number; nullopt: it cannot be made before another one is over.
  using Make = std::function<std::optional<Trial>(std::size_t index)>;
  using Over = std::function<void(std::size_t index, TrialOutcome outcome)>;

  /// @param plan, console  must outlive this.
  TrialFlights(const HuntPlan& plan, const Console& console) : plan_(plan), console_(console) {}

  /// From now on evaluates only this property; "": all properties of the hunt. This saves time, and the runs without
  /// faults with which only other properties compare.
  void ask(const std::string& property) { asked_ = property; }
  /// Flies the runs without faults with which properties compare these trials, each once. @throws Interrupted.
  void fly_undisturbed(const std::vector<Trial>& trials);
  /// Flies the trials with these numbers in this order, several at once. A trial that `skein run` refuses as bad input
  /// has an outcome without findings. Call fly_undisturbed() for these trials before. @throws Interrupted.
  void fly(const std::vector<std::size_t>& numbers, const Make& make, const Over& over);
  std::vector<TrialOutcome> fly(const std::vector<Trial>& trials);  ///< calls fly_undisturbed() itself
  /// The same with the engine that the hunt's options name, in rounds of at most `round` trials: no outcome is read
  /// before a whole round has flown. @throws Interrupted; InputError when the engine fails to fly a unit of a round.
  void fly_in_rounds(const std::vector<std::size_t>& numbers, const Make& make, const Over& over);
  /// Flies one trial, with fly_undisturbed(), and keeps its folder `trial.run.out`. @throws Interrupted.
  TrialOutcome fly_and_keep(const Trial& trial);

  std::size_t flown() const { return flown_; }

 private:
  struct Setting {
    Scenario scenario;
    properties::PropertySet set;
  };

  /// nullptr: the trial's scenario or properties are invalid.
  const Setting* setting_of(const Trial& trial);
  static std::string name_of_trial(std::size_t index);
  std::filesystem::path dir_of(const std::string& name) const;
  ProgramSpec start(const Trial& trial, const std::filesystem::path& dir) const;
  void fly_round(const std::vector<std::size_t>& numbers, const std::vector<Trial>& trials, const Over& over);
  TrialOutcome read(const Trial& trial, const std::filesystem::path& dir, const ExitStatus& exit);
  properties::PropertySet asked(const properties::PropertySet& set) const;

  const HuntPlan& plan_;
  const Console console_;
  std::map<std::string, std::optional<Setting>> settings_;    ///< by what_is_flown()
  std::map<std::string, std::filesystem::path> undisturbed_;  ///< folders of runs without faults, by what_is_flown()
  std::size_t flown_ = 0;
  std::string asked_;  ///< see ask()
};

}  // namespace skein::cli
