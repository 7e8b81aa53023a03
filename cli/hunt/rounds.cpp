// Rounds of a hunt, each a sweep (cli/sweep/): the cases of a round are fixed before the first of them flies, so that
// the search does not depend on which node flies which case.
#include <map>
#include <set>

#include "cli/hunt/flights.hpp"
#include "cli/study/flights.hpp"
#include "cli/study/made_under.hpp"
#include "cli/sweep/controller.hpp"
#include "cli/sweep/engines.hpp"
#include "cli/sweep/this_machine.hpp"
#include "core/types.hpp"
#include "host/machine.hpp"
#include "host/preflight.hpp"
#include "process/files/atomic_file.hpp"
#include "run/run_options.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

constexpr double kReferenceMission_s = 20.0;  ///< longest mission of the reference flight

ExitStatus exit_in(const fs::path& dir) {
  const Json exit = value_or(read_json(dir / kFlightMark), "exit", Json::object());
  const auto number = [&](const char* key) { return static_cast<int>(value_or(exit, key, 0).get<std::int64_t>()); };
  ExitStatus status;
  status.code = number("code");
  status.signal = number("signal");
  return status;
}

/// The reference flight of all rounds: the hunt's flight without faults, cut short.
SweepFlight reference(const HuntPlan& plan, const SweepFolder& folder, MadeUnder& made_under) {
  RunOptions run = plan.fleet.options;
  run.duration_s = std::min(plan.fleet.scenario.duration_s, kReferenceMission_s);
  run.seed = 1;
  run.attainable = run.report = false;
  return {0, folder.dir() / "reference", run, made_under.of(plan_fleet(run, program_dir()))};
}

/// Removes the fault files of earlier rounds, of which a long hunt would leave many. Once the sweep is that of this
/// round, no program needs them.
void keep_only(const std::set<fs::path>& of_this_round, const fs::path& cases) {
  std::vector<fs::path> others;
  for (const fs::directory_entry& entry : fs::directory_iterator(cases)) {
    if (!of_this_round.contains(entry.path())) others.push_back(entry.path());
  }
  for (const fs::path& file : others) SweepFolder::remove(file);
}

}  // namespace

void TrialFlights::fly_in_rounds(const std::vector<std::size_t>& numbers, const Make& make, const Over& over) {
  for (auto next = numbers.begin(); next != numbers.end();) {
    std::vector<std::size_t> round;
    std::vector<Trial> trials;
    for (; next != numbers.end() && round.size() < plan_.options.round; ++next) {
      std::optional<Trial> trial = make(*next);
      if (!trial) break;
      round.push_back(*next);
      trials.push_back(std::move(*trial));
    }
    if (round.empty()) return;
    fly_round(round, trials, over);
  }
}

void TrialFlights::fly_round(const std::vector<std::size_t>& numbers, const std::vector<Trial>& trials,
                             const Over& over) {
  SweepFolder folder(fs::absolute(plan_.out));
  MadeUnder made_under;
  std::vector<SweepFlight> flights;
  std::map<std::size_t, std::size_t> refused;  // cases that are invalid input; value: index in `trials`
  std::set<fs::path> fault_files;
  const fs::path cases = folder.dir() / "cases";
  fs::create_directories(cases);
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const std::string name = name_of_trial(numbers[i]);
    RunOptions run = trials[i].run;
    run.out = dir_of(name);
    if (!trials[i].faults.empty()) {
      run.faults = cases / (name + ".yaml");
      fault_files.insert(*run.faults);
      write_file_atomically(*run.faults, trials[i].text());
    }
    try {
      flights.push_back({flights.size(), *run.out, run, made_under.of(plan_fleet(run, program_dir()))});
      flights.back().made_under["case"] = numbers[i];
    } catch (const InputError&) {
      refused.emplace(numbers[i], i);
    }
  }
  if (!flights.empty()) {
    const SweepNode here = this_machine(console_);
    const auto engine = make_engine(plan_.options.sweep, plan_.options.jobs, folder, console_);
    SweepController controller(folder, *engine, here, console_.err);
    const auto slots = static_cast<std::size_t>(plan_.options.jobs.value_or(usable_cores()));
    controller.plan({flights.size(),
                     [&](std::size_t index) { return flights[index]; },
                     {reference(plan_, folder, made_under)},
                     [&](double) {
                       return UnitSizes{flights.size(), std::max<std::size_t>(1, flights.size() / (4 * slots))};
                     },
                     plan_.options.sweep.command,
                     fs::current_path()});
    keep_only(fault_files, cases);
    write_fly_script(folder, fs::absolute(plan_.out), fs::current_path(), plan_.options.jobs);
    if (!controller.fly()) throw Interrupted{};
    for (const auto& [unit, words] : controller.failed()) {
      throw InputError("unit " + std::to_string(unit) + " of this round was not flown: " + words +
                       "\nThe same command continues the hunt.");
    }
  }
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const fs::path dir = dir_of(name_of_trial(numbers[i]));
    TrialOutcome outcome = refused.contains(numbers[i]) ? TrialOutcome{} : read(trials[i], dir, exit_in(dir));
    SweepFolder::remove(dir);
    over(numbers[i], std::move(outcome));
  }
}

}  // namespace skein::cli
