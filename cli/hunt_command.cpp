#include "cli/hunt_command.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <set>
#include <thread>

#include "cli/hunt/finds.hpp"
#include "cli/hunt/log.hpp"
#include "cli/hunt/report.hpp"
#include "cli/study/flights.hpp"
#include "core/faults/fault_writer.hpp"
#include "core/text/text.hpp"
#include "host/preflight.hpp"
#include "process/program.hpp"
#include "run/fleet_programs.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostRuns = 1'000'000;
constexpr double kTellPeriod_s = 10.0;

double seconds_since(Clock::time_point then) { return std::chrono::duration<double>(Clock::now() - then).count(); }

/// One call of `skein hunt`.
class Hunt {
 public:
  Hunt(const HuntPlan& plan, const Console& console)
      : plan_(plan),
        console_(console),
        log_(plan.out, plan.settings, plan.options.force),
        search_(FaultMaker(plan.fleet.scenario, plan.space), plan.options.seed, plan.options.round,
                plan.options.conditions),
        flights_(plan, console),
        finds_(plan, flights_, console),
        wanted_(plan.options.runs.value_or(kMostRuns)) {}

  int run() {
    bool interrupted = false;
    for (const fs::path& capsule : log_.kept()) {
      console_.err << "a find of the earlier hunt is kept: " << capsule.string() << std::endl;
    }
    try {
      search();
      for (const Failure& failure : failures_of(log_.outcomes(), flown())) {
        finds_.go_into(failure, trial(failure.index), *log_.outcomes()[failure.index]);
      }
    } catch (const Interrupted&) {
      interrupted = true;  // the flights so far are in the log, and the capsules are written
    }
    tell_end();
    if (interrupted) throw Interrupted{};
    // Nothing was found, but nothing was searched either.
    if (const std::size_t count = flown(); count > 0 && not_flown(count) == count) {
      throw InputError("hunt: no case could be flown; `skein run` with the same options says why");
    }
    return finds_.all().empty() ? kExitDone : kExitCheckFailed;
  }

 private:
  Trial trial(std::size_t index) {
    while (search_.cases().size() <= index) search_.next(log_.outcomes());
    const HuntCase& flown = search_.cases()[index];
    Trial trial{plan_.fleet.options, flown.faults};
    trial.run.seed = flown.seed;
    if (!flown.conditions.empty()) trial.run.conditions = flown.conditions;
    trial.run.duration_s = plan_.fleet.scenario.duration_s;
    return trial;
  }
  static std::string flown_text(const Trial& trial) {
    const std::string conditions = trial.run.conditions ? "conditions: " + *trial.run.conditions + "\n" : "";
    return "seed: " + std::to_string(trial.run.seed) + "\n" + conditions + trial.text();
  }

  void search() {
    std::vector<std::size_t> numbers;
    const auto& before = log_.outcomes();
    for (std::size_t i = 0; i < wanted_; ++i) {
      if (i >= before.size() || !before[i]) numbers.push_back(i);
    }
    if (numbers.size() < wanted_) {
      console_.err << wanted_ - numbers.size() << " of " << wanted_ << " runs are complete already" << std::endl;
    }
    for (std::size_t i = 0; i < before.size() && i < wanted_; ++i) {
      if (before[i] && can_make(i)) log_.check(i, flown_text(trial(i)));
    }
    std::vector<Trial> undisturbed;
    for (std::uint64_t seed = 1; seed <= HuntSearch::kRunSeeds; ++seed) {
      const std::size_t settings = std::max<std::size_t>(plan_.options.conditions.size(), 1);
      for (std::size_t i = 0; i < settings; ++i) {
        undisturbed.push_back(trial(0));
        undisturbed.back().run.seed = seed;
        if (!plan_.options.conditions.empty()) undisturbed.back().run.conditions = plan_.options.conditions[i];
      }
    }
    flights_.fly_undisturbed(undisturbed);
    const auto make = [this](std::size_t index) -> std::optional<Trial> {
      if (is_enough(index) || !can_make(index)) return std::nullopt;
      return trial(index);
    };
    const auto over = [this](std::size_t index, TrialOutcome outcome) {
      log_.add(index, flown_text(trial(index)), std::move(outcome));
      ++flown_now_;
      last_ = Clock::now();
      tell_progress();
    };
    plan_.options.sweep.executor ? flights_.fly_in_rounds(numbers, make, over) : flights_.fly(numbers, make, over);
  }

  /// Whether the outcomes that this case is drawn from are all known.
  bool can_make(std::size_t index) {
    while (search_.cases().size() <= index) {
      if (!search_.may_go_on(log_.outcomes())) return false;
      search_.next(log_.outcomes());
    }
    return true;
  }

  /// Whether a case need not be flown any more. Cases before the first known failure are flown: they may fail too.
  bool is_enough(std::size_t index) const {
    if (plan_.options.minutes && seconds_since(began_) > 60.0 * *plan_.options.minutes) return true;
    if (!plan_.options.first) return false;
    const std::vector<Failure> failures = failures_of(log_.outcomes(), wanted_);
    return !failures.empty() && failures.front().index < index;
  }

  /// How many cases count: those before the first gap and, where the first find ends the search, up to that find.
  std::size_t flown() const {
    const auto& outcomes = log_.outcomes();
    const auto gap = std::ranges::find_if(outcomes, [](const auto& outcome) { return !outcome.has_value(); });
    const std::size_t count = std::min(static_cast<std::size_t>(gap - outcomes.begin()), wanted_);
    if (!plan_.options.first) return count;
    const std::vector<Failure> failures = failures_of(outcomes, count);
    return failures.empty() ? count : failures.front().index + 1;
  }

  /// How many of the first `count` cases `skein run` refused to fly.
  std::size_t not_flown(std::size_t count) const {
    const auto& outcomes = log_.outcomes();
    return static_cast<std::size_t>(std::count_if(outcomes.begin(),
                                                  outcomes.begin() + static_cast<std::ptrdiff_t>(count),
                                                  [](const auto& outcome) { return outcome->findings.empty(); }));
  }

  std::string margins_text() const {
    std::map<std::string, double> least;
    for (const auto& outcome : log_.outcomes()) {
      for (const TrialFinding& finding : outcome ? outcome->findings : std::vector<TrialFinding>{}) {
        if (!finding.margin) continue;
        const auto [one, first] = least.try_emplace(finding.property, *finding.margin);
        if (!first) one->second = std::min(one->second, *finding.margin);
      }
    }
    std::string text;
    for (const auto& [name, margin] : least)
      text += (text.empty() ? "" : ", ") + name + " " + significant(margin + 0.0, 3);
    return text;
  }

  std::size_t states_met() const {
    std::set<std::uint64_t> states;
    for (const auto& outcome : log_.outcomes()) {
      if (outcome) states.insert(outcome->states.begin(), outcome->states.end());
    }
    return states.size();
  }

  void tell_progress() {
    if (seconds_since(told_) < kTellPeriod_s) return;
    told_ = Clock::now();
    const double rate = static_cast<double>(flown_now_) / seconds_since(began_);
    const std::size_t over = flown();
    std::string line = fmt::format("{} runs", over);
    if (plan_.options.runs) line = fmt::format("{} of {} runs", over, wanted_);
    line += fmt::format(", {:.2f} a second, {} states, {} failures", rate, states_met(),
                        failures_of(log_.outcomes(), wanted_).size());
    if (plan_.options.runs) {
      line += ", about " + duration_text(static_cast<double>(wanted_ - over) / rate) + " left";
    }
    console_.err << line << "; least margins: " << margins_text() << std::endl;
  }

  void tell_end() {
    const std::size_t count = flown();
    const HuntSummary summary{plan_, log_.outcomes(), count, states_met(), finds_.all(), finds_.counts()};
    write_hunt_report(summary);
    console_.out << fmt::format("{} runs, {} states, {} finds", count, summary.states, finds_.all().size());
    if (flown_now_ > 0) {
      console_.out << fmt::format("; {:.0f} runs an hour",
                                  3600.0 * static_cast<double>(flown_now_) / std::max(0.1, search_s()));
    }
    console_.out << '\n';
    if (const std::size_t none = not_flown(count); none > 0) {
      console_.out << fmt::format("{} runs do not count: `skein run` refused to fly them\n", none);
    }
    for (const Find& find : finds_.all()) {
      console_.out << "FIND " << find.name << ": " << find.property << ": " << find.told << '\n';
      for (const Fault& fault : find.trial.faults) console_.out << "     " << fault_line(fault) << '\n';
      console_.out << fmt::format("     {} failures in all; minimised with {} flights in {:.0f} s{}\n",
                                  finds_.counts().at(find.broke), find.flights, find.wall_s,
                                  find.over_dds ? "; the same over DDS" : "");
      console_.out << "     " << find.capsule.string() << '\n';
    }
    console_.out << std::flush;
  }
  double search_s() const { return std::chrono::duration<double>(last_ - began_).count(); }

  const HuntPlan& plan_;
  const Console console_;
  HuntLog log_;
  HuntSearch search_;
  TrialFlights flights_;
  Finds finds_;
  const std::size_t wanted_;
  const Clock::time_point began_ = Clock::now();
  Clock::time_point told_ = began_, last_ = began_;
  std::size_t flown_now_ = 0;
};

/// Lets the programs themselves check the plan, once for all flights of the hunt.
void check_once(const HuntPlan& plan) {
  const ScratchDir scratch;
  run_checks(check_programs(plan.fleet, scratch.path()));
}

/// @throws InputError for a report that could not be written at the end of the hunt.
void check_report_folder(const HuntOptions& options) {
  if (!options.junit) return;
  const fs::path folder = fs::absolute(*options.junit).parent_path();
  std::error_code error;
  if (fs::is_directory(folder, error)) return;
  throw InputError("--junit " + options.junit->string() + ": there is no folder " + folder.string());
}

}  // namespace

int run_hunt(const HuntOptions& given, const Console& console) {
  HuntOptions options = given;
  if (!options.runs && !options.minutes) options.runs = 200;
  const HuntPlan plan = plan_hunt(options);
  check_once(plan);
  Hunt hunt(plan, console);  // it makes the folder of the hunt, which may be that of the report, too
  check_report_folder(options);
  return hunt.run();
}

}  // namespace skein::cli
