#include "cli/fault_test_command.hpp"

#include <cstdlib>
#include <map>
#include <set>
#include <sstream>

#include "cli/fault_test.hpp"
#include "cli/preflight.hpp"
#include "cli/test_command.hpp"

namespace skein::cli {
namespace {

/// Set for as long as it lives; what programs that start meanwhile inherit.
class ScopedVariable {
 public:
  ScopedVariable(const char* name, const std::string& value) : name_(name) {
    if (const char* former = std::getenv(name)) former_ = former;
    ::setenv(name, value.c_str(), 1);
  }
  ~ScopedVariable() {
    if (former_) {
      ::setenv(name_, former_->c_str(), 1);
    } else {
      ::unsetenv(name_);
    }
  }
  ScopedVariable(const ScopedVariable&) = delete;
  ScopedVariable& operator=(const ScopedVariable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> former_;
};

/// The repetitions that the command line asks for.
std::vector<Repeat> asked_repeats(const TestOptions& options) {
  if (options.long_tests) return {Repeat::again, Repeat::fastdds, Repeat::mixed, Repeat::chaos};
  std::vector<Repeat> repeats;
  for (const std::string& word : options.repeat) {
    for (const auto& entry : enum_names(Repeat{})) {
      if (word == entry.name) repeats.push_back(entry.value);
    }
  }
  return repeats;
}

/// Names a run but for its faults and DDS vendor, which do not show in a run without faults.
std::string what_is_flown(const RunOptions& options) {
  std::ostringstream text;
  text << options.scenario << '\n' << options.planner << '\n' << options.seed << '\n' << *options.duration_s << '\n';
  if (options.scene_seed) text << *options.scene_seed;
  return text.str();
}

/// What the programs themselves say to what the tests fly. @throws InputError.
void check_with_programs(const std::vector<FaultTest>& tests) {
  std::set<std::string> checked;
  for (const FaultTest& test : tests) {
    if (!checked.insert(what_is_flown(test.plan.options)).second) continue;
    const ScratchDir scratch;
    try {
      run_checks(check_programs(test.plan, scratch.path()));
    } catch (const InputError& error) {
      throw InputError(test.plan.faults.file.string() + ": run: " + error.what());
    }
  }
}

/// A run of a test and how it ended.
struct Flight {
  RunRecord record;
  int exit_code = 0;
};

/// One call of `skein test --faults`.
class FaultTestRun {
 public:
  FaultTestRun(const TestOptions& options, const Console& console)
      : options_(options), console_(console), out_(std::filesystem::absolute(options.out)) {}

  TestCounts fly_all(const std::vector<FaultTest>& tests) {
    TestCounts counts;
    for (std::size_t i = 0; i < tests.size(); ++i) {
      const std::vector<std::string> broken = fly(tests[i], i);
      console_.out << (broken.empty() ? "PASS " : "FAIL ") << tests[i].name << std::endl;
      for (const std::string& sentence : broken) console_.out << "     " << sentence << std::endl;
      if (!broken.empty()) console_.out << "     results: " << (out_ / tests[i].name).string() << std::endl;
      ++(broken.empty() ? counts.passed : counts.failed);
    }
    return counts;
  }

 private:
  /// @returns what does not hold.
  std::vector<std::string> fly(const FaultTest& test, std::size_t index) try {
    const Flight flight = fly(test.plan.options, test.name);
    Evidence evidence{test.plan.scenario, test.plan.faults, flight.record, flight.exit_code, nullptr, {}};
    if (test.needs_fault_free()) evidence.fault_free = &fault_free(test);
    std::map<std::string, RunRecord> repeats;
    for (const Repeat repeat : repeats_of(test, index)) {
      const std::string how = name_of(repeat);
      repeats.insert_or_assign(how, fly_again(test, repeat, index));
    }
    for (const auto& [how, record] : repeats) evidence.repeats.emplace_back(how, &record);
    return broken_expectations(test.expect, evidence);
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& error) {  // a run that left no result
    return {error.what()};
  }

  std::vector<Repeat> repeats_of(const FaultTest& test, std::size_t index) const {
    std::vector<Repeat> all = test.repeats();
    const std::vector<Repeat> asked = asked_repeats(options_);
    if (options_.rotate && !asked.empty()) {
      all.push_back(asked[index % asked.size()]);
    } else {
      all.insert(all.end(), asked.begin(), asked.end());
    }
    return all;
  }

  RunRecord fly_again(const FaultTest& test, Repeat repeat, std::size_t index) {
    RunOptions options = test.plan.options;
    const std::string name = test.name + "-" + name_of(repeat);
    if (repeat == Repeat::chaos) {
      const ScopedVariable chaos("SKEIN_CHAOS", std::to_string(index + 1));
      return fly(options, name).record;
    }
    if (repeat != Repeat::again) options.dds = name_of(repeat);
    return fly(options, name).record;
  }

  const RunRecord& fault_free(const FaultTest& test) {
    RunOptions options = test.plan.options;
    options.faults.reset();
    const auto [found, is_new] = fault_free_.try_emplace(what_is_flown(options));
    if (is_new) {
      const std::string name = "without-faults-" + std::to_string(fault_free_.size());
      found->second = fly(options, name).record;
    }
    return found->second;
  }

  Flight fly(RunOptions options, const std::string& name) {
    console_.err << "flying " << name << std::endl;
    options.out = out_ / name;
    std::filesystem::create_directories(out_);
    std::ostringstream out, err;
    const int code = run_fleet(options, {out, err, false});
    if (code == kExitInterrupted) throw Interrupted{};
    return {read_run(*options.out), code};
  }

  const TestOptions& options_;
  const Console& console_;
  const std::filesystem::path out_;
  std::map<std::string, RunRecord> fault_free_;  ///< by what was flown
};

}  // namespace

int run_fault_tests(const TestOptions& options, const Console& console) {
  std::vector<FaultTest> tests;
  std::string wrong;
  for (const std::filesystem::path& file : fault_test_files(*options.faults)) {
    try {
      tests.push_back(load_fault_test(file, options.assets));
    } catch (const InputError& error) {
      wrong += (wrong.empty() ? "" : "\n") + std::string(error.what());
    }
  }
  if (!wrong.empty()) throw InputError(wrong);
  check_with_programs(tests);
  const TestCounts counts = FaultTestRun(options, console).fly_all(tests);
  console.out << summary_line(counts) << std::endl;
  return counts.failed == 0 ? kExitDone : kExitCheckFailed;
}

}  // namespace skein::cli
