#include "cli/test_command.hpp"

#include <chrono>
#include <map>
#include <numeric>

#include "cli/fault_tests/flights.hpp"
#include "cli/fault_tests/report.hpp"
#include "cli/option_checks.hpp"
#include "cli/study/side_by_side.hpp"
#include "cli/study/spec.hpp"
#include "cli/test_counts.hpp"
#include "host/preflight.hpp"
#include "host/supervisor.hpp"
#include "process/files/atomic_file.hpp"
#include "process/program.hpp"
#include "results/run_folder.hpp"
#include "run/fleet_programs.hpp"
#include "run/results_dir.hpp"
#include "signals/judge.hpp"
#include "signals/run_signals.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kTailLines = 5;

/// Lets the programs themselves check what the tests fly: also tests of the same run, because each has its own faults.
/// @throws InputError.
void check_with_programs(const std::vector<FaultTest>& tests) {
  for (const FaultTest& test : tests) {
    const ScratchDir scratch;
    try {
      run_checks(check_programs(test.plan, scratch.path()));
    } catch (const InputError& error) {
      throw InputError(test.plan.faults.file.string() + ": run: " + error.what());
    }
  }
}

/// Loads the tests of all files. @throws InputError that lists the errors of all files.
std::vector<FaultTest> load_all(const TestOptions& options) {
  std::vector<FaultTest> tests;
  std::string wrong;
  for (const fs::path& file : fault_test_files(*options.faults)) {
    try {
      tests.push_back(load_fault_test(file, options.assets, options.agent, options.one_process));
    } catch (const InputError& error) {
      wrong += (wrong.empty() ? "" : "\n") + std::string(error.what());
    }
  }
  if (!wrong.empty()) throw InputError(wrong);
  check_with_programs(tests);
  return tests;
}

/// Each test with each of these seeds: all seeds of the first test, then those of the next.
std::vector<FaultTest> with_seeds(const std::vector<FaultTest>& tests, const std::vector<std::uint64_t>& seeds) {
  std::vector<FaultTest> all;
  for (const FaultTest& test : tests) {
    for (const std::uint64_t seed : seeds) {
      all.push_back(with_seed(test, seed));
      all.back().name += "-seed-" + std::to_string(seed);
    }
  }
  return all;
}

/// One call of `skein test --faults`.
class FaultTestRun {
 public:
  FaultTestRun(std::vector<FaultTest> tests, const TestOptions& options, const Console& console)
      : tests_(std::move(tests)),
        options_(options),
        console_(console),
        flights_(plan_fault_flights(tests_, options)),
        flown_(flights_.flights.size()) {
    for (const FaultTest& test : tests_) {
      FaultVerdict& verdict = verdicts_.emplace_back();
      verdict.name = test.name;
      verdict.file = test.file;
      verdict.results = fs::absolute(options.out) / test.name;
    }
  }

  /// @throws Interrupted.
  TestCounts fly() {
    write_report();  // before anything flies, so that a report that cannot be written is known early
    std::deque<std::size_t> waiting(flights_.flights.size());
    std::iota(waiting.begin(), waiting.end(), std::size_t{0});
    SideBySide side_by_side(static_cast<std::size_t>(options_.jobs), console_);
    const bool all = side_by_side.fly(
        std::move(waiting), [this](std::size_t index) { return start(index); },
        [this](std::size_t index, const ExitStatus& exit) { on_exit(index, exit); });
    if (!all) throw Interrupted{};
    return counts_;
  }

 private:
  /// How a flight ended; `exit` is set once it has.
  struct Flown {
    Clock::time_point began{};
    double wall_s = 0.0;
    std::optional<ExitStatus> exit;
  };

  ProgramSpec start(std::size_t index) {
    const FaultFlight& flight = flights_.flights[index];
    console_.err << "flying " << flight.name << std::endl;
    const fs::path dir = *flight.options.out;
    if (const std::error_code error = make_results_folder(dir)) throw std::system_error(error, dir);
    fs::remove(dir / run_folder::kResult);  // of an earlier call
    std::map<std::string, std::string> variables;
    if (flight.chaos) variables["SKEIN_CHAOS"] = std::to_string(*flight.chaos);
    flown_[index].began = Clock::now();
    return flight_program(flight.options, variables);
  }

  void on_exit(std::size_t index, const ExitStatus& exit) {
    flown_[index].exit = exit;
    flown_[index].wall_s = std::chrono::duration<double>(Clock::now() - flown_[index].began).count();
    for (; told_ < tests_.size() && is_over(flights_.tests[told_]); ++told_) tell(told_);
  }

  /// A test's flights, without the fault-free one that it may share with other tests.
  static std::vector<std::size_t> own_flights(const FlightsOfTest& flights) {
    std::vector<std::size_t> all = {flights.own};
    for (const auto& [how, index] : flights.repeats) all.push_back(index);
    return all;
  }

  bool is_over(const FlightsOfTest& flights) const {
    std::vector<std::size_t> all = own_flights(flights);
    if (flights.fault_free) all.push_back(*flights.fault_free);
    return std::all_of(all.begin(), all.end(), [this](std::size_t index) { return flown_[index].exit.has_value(); });
  }

  /// Prints a test's verdict. Tests are reported in their order, whichever ended first.
  void tell(std::size_t index) {
    FaultVerdict& verdict = verdicts_[index];
    for (const std::size_t flight : own_flights(flights_.tests[index])) verdict.wall_s += flown_[flight].wall_s;
    verdict.flown = true;
    try {
      judge(index, verdict);
    } catch (const std::runtime_error& error) {  // a run that left no result
      verdict.broken.push_back(tests_[index].said_of("run", error.what()));
    }
    print_verdict(console_.out, verdict, options_.verbose);
    ++(verdict.passed() ? counts_.passed : counts_.failed);
    write_report();
  }

  void judge(std::size_t index, FaultVerdict& verdict) const {
    const FaultTest& test = tests_[index];
    const FlightsOfTest& flights = flights_.tests[index];
    const results::RunRecord own = record_of(flights.own);
    Evidence evidence{test.plan.faults, own, flown_[flights.own].exit->code, {}};
    std::optional<results::RunRecord> fault_free;
    if (flights.fault_free) fault_free = record_of(*flights.fault_free);
    std::map<std::string, results::RunRecord> repeats;
    for (const auto& [how, flight] : flights.repeats) repeats.emplace(how, record_of(flight));
    for (const auto& [how, record] : repeats) evidence.repeats.emplace_back(how, &record);
    for (const Judgement& judgement : judged(test.expect, evidence)) {
      (judgement.holds ? verdict.held : verdict.broken).push_back(test.said_of(judgement.path, judgement.text));
    }
    judge_properties_of(test, own, fault_free ? &*fault_free : nullptr, verdict);
  }

  static void judge_properties_of(const FaultTest& test, const results::RunRecord& own,
                                  const results::RunRecord* fault_free, FaultVerdict& verdict) {
    if (test.property_set.empty()) return;
    using Outcome = properties::Verdict::Outcome;
    signals::FolderSignals signals(own, test.plan.scenario, fault_free, &test.plan.faults);
    for (const signals::PropertyFinding& finding : signals::judge_properties(test.property_set, signals)) {
      const Outcome outcome = finding.verdict.outcome;
      // A default property that the file does not mention need not have anything to judge.
      const bool is_quiet = outcome == Outcome::holds || (outcome == Outcome::vacuous && !test.states(finding.name));
      (is_quiet                    ? verdict.held
       : outcome == Outcome::fails ? verdict.broken
                                   : verdict.vacuous)
          .push_back(test.said_of("properties." + finding.name, finding.text()));
    }
  }

  /// @throws std::runtime_error, with the end of the flight's log, when the flight left no result.
  results::RunRecord record_of(std::size_t index) const {
    const fs::path dir = *flights_.flights[index].options.out;
    if (fs::exists(dir / run_folder::kResult)) return results::read_run(dir);
    std::string message = "skein run ended with " + flown_[index].exit->text() + " and without a result";
    for (const std::string& line : last_lines(dir / run_folder::kFlightLog, kTailLines)) message += "\n       " + line;
    throw std::runtime_error(message);
  }

  void write_report() const {
    if (!options_.junit) return;
    try {
      replace_or_overwrite(*options_.junit, junit_xml("skein test --faults " + options_.faults->string(), verdicts_));
    } catch (const std::runtime_error& error) {
      throw InputError("--junit: " + std::string(error.what()));
    }
  }

  const std::vector<FaultTest> tests_;
  const TestOptions& options_;
  const Console console_;
  const FaultFlights flights_;
  std::vector<Flown> flown_;            ///< by flight
  std::vector<FaultVerdict> verdicts_;  ///< by test
  std::size_t told_ = 0;                ///< number of tests reported so far
  TestCounts counts_;
};

/// @throws InputError for unusable output paths, which would otherwise be noticed only after the flights.
void check_places(const TestOptions& options) {
  std::error_code error;
  fs::create_directories(options.out, error);
  if (error) throw InputError("--out " + options.out.string() + ": " + error.message());
  if (!options.junit) return;
  if (const std::string wrong = check_file_to_write(*options.junit); !wrong.empty()) {
    throw InputError("--junit: " + wrong);
  }
}

}  // namespace

int run_fault_tests(const TestOptions& options, const Console& console) {
  const auto seeds = options.seeds ? std::optional(parse_seeds(*options.seeds)) : std::nullopt;
  std::vector<FaultTest> tests = load_all(options);
  if (seeds) tests = with_seeds(tests, *seeds);
  check_places(options);
  const TestCounts counts = FaultTestRun(std::move(tests), options, console).fly();
  console.out << summary_line(counts) << std::endl;
  return counts.failed == 0 ? kExitDone : kExitCheckFailed;
}

}  // namespace skein::cli
