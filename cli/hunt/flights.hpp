// The flights of a hunt: each is a `skein run` in a folder of its own, which is gone once it has been looked at.
// From one thread, which must live as long as the flights.
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
  /// The trial with this number, or none before another one is over.
  using Make = std::function<std::optional<Trial>(std::size_t index)>;
  using Over = std::function<void(std::size_t index, TrialOutcome outcome)>;

  /// @param plan, console  must outlive this.
  TrialFlights(const HuntPlan& plan, const Console& console) : plan_(plan), console_(console) {}

  /// From now on only this property is asked; "" means all of the hunt. Fewer are looked at in less time, and fewer
  /// runs without faults are flown to compare with.
  void ask(const std::string& property) { asked_ = property; }
  /// Flies the runs without faults that properties compare these with, each once. @throws Interrupted.
  void fly_undisturbed(const std::vector<Trial>& trials);
  /// Flies trials with these numbers in their order, several at once. One that cannot be flown, since it is not what a
  /// file may say, has an outcome without findings. What they are compared with was flown before. @throws Interrupted.
  void fly(const std::vector<std::size_t>& numbers, const Make& make, const Over& over);
  std::vector<TrialOutcome> fly(const std::vector<Trial>& trials);
  /// The same by the engine that the hunt's options name: as many as can be made fly before anything is looked at, then
  /// the next ones. @throws Interrupted; InputError when the engine does not fly one.
  void fly_in_rounds(const std::vector<std::size_t>& numbers, const Make& make, const Over& over);
  /// Keeps its folder, which `trial.run.out` names. @throws Interrupted.
  TrialOutcome fly_and_keep(const Trial& trial);

  std::size_t flown() const { return flown_; }

 private:
  struct Setting {
    Scenario scenario;
    properties::PropertySet set;
  };

  /// nullptr: it makes no sense.
  const Setting* setting_of(const Trial& trial);
  static std::string name_of_trial(std::size_t index);
  std::filesystem::path dir_of(const std::string& name) const;
  ProgramSpec start(const Trial& trial, const std::filesystem::path& dir) const;
  void fly_round(const std::vector<std::size_t>& numbers, const std::vector<Trial>& trials, const Over& over);
  TrialOutcome read(const Trial& trial, const std::filesystem::path& dir, const ExitStatus& exit);
  properties::PropertySet asked(const properties::PropertySet& set) const;

  const HuntPlan& plan_;
  const Console& console_;
  std::map<std::string, std::optional<Setting>> settings_;    ///< by what is flown
  std::map<std::string, std::filesystem::path> undisturbed_;  ///< folders of runs without faults, by what is flown
  std::size_t flown_ = 0;
  std::string asked_;  ///< see ask()
};

}  // namespace skein::cli
