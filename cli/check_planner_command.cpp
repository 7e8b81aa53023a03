#include "cli/check_planner_command.hpp"

#include <sys/wait.h>

#include <spdlog/fmt/fmt.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <sstream>

#include "cli/option_checks.hpp"
#include "cli/run_command.hpp"
#include "cli/study/flights.hpp"
#include "core/planners/python_spec.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "core/text/number_checks.hpp"
#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "host/machine.hpp"
#include "host/preflight.hpp"
#include "host/program_start.hpp"
#include "process/files/atomic_file.hpp"
#include "process/host/other_clock.hpp"
#include "process/json_text.hpp"
#include "process/program.hpp"
#include "results/diff.hpp"
#include "results/run_folder.hpp"
#include "run/fleet_plan.hpp"
#include "run/results_dir.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

/// Process surroundings in which a mission is flown again.
struct Surroundings {
  std::string name, what;  ///< as text for the user
  std::string causes;      ///< the usual causes if the run differs in these surroundings
  std::map<std::string, std::string> variables = {};
  std::optional<std::string> dds = {};  ///< fly in processes over this vendor's DDS; none: as in the first run
  bool busy = false;                    ///< other processes keep all processors busy
};

/// Shift of the wall clock [s]: three hundred days back, so that a planner's wait until some wall time ends at once.
constexpr const char* kOtherTime = "-25920000";

constexpr std::size_t kMissions = 2;  ///< one without faults, one with a restart
constexpr double kUsualCheck_s = 40.0;
constexpr double kRestart_s = 3.0;  ///< how long the program is gone; it ends after a third of the mission
/// A restart must begin after the start, and end before the mission does.
constexpr double kLeastCheck_s = 6.0;

/// The library that shifts the clock: beside the programs, or where it is installed.
fs::path other_clock(const fs::path& bin_dir) {
  const fs::path beside = bin_dir / kOtherClockLibrary;
  return fs::exists(beside) ? beside : bin_dir.parent_path() / "lib" / "skein" / kOtherClockLibrary;
}

/// @param python  whether a planner of the fleet is written in Python.
std::vector<Surroundings> all_surroundings(const fs::path& bin_dir, bool python) {
  const std::string order = "the order in which messages arrive, timers, or threads";
  std::vector<Surroundings> all = {
      {"again", "the same once more, at other addresses",
       "a random device, the order of a hash map over pointers, the wall clock, or threads"},
      {"heap",
       "memory full of other bytes",
       "memory that is read before anything was written there",
       {{"MALLOC_PERTURB_", "173"}}},
      {"clock",
       "another time of the wall clock",
       "the wall clock",
       {{"LD_PRELOAD", other_clock(bin_dir)}, {kOtherClockVariable, kOtherTime}}},
      {"load", "beside others who want the processors", "time that is measured, or threads", {}, {}, true},
      {"cyclonedds",
       "processes over Cyclone DDS",
       "something that UAVs share in one process or that outlives a restart there: a static variable",
       {},
       "cyclonedds"},
      {"fastdds", "processes over Fast DDS", order, {}, "fastdds"},
      {"chaos", "arrivals delayed and reordered at random", order, {{"SKEIN_CHAOS", "7"}}, "cyclonedds"},
  };
  if (python) {
    all.push_back({"hash",
                   "another seed of Python's hashes",
                   "the order of a set of texts, or hash() of one",
                   {{"SKEIN_HASH_SEED", "4711"}}});
  }
  return all;
}

/// While it lives, sets environment variables of this process, which all programs that it starts inherit.
class Variables {
 public:
  explicit Variables(const std::map<std::string, std::string>& variables) {
    for (const auto& [name, value] : variables) {
      const char* before = std::getenv(name.c_str());
      former_.emplace_back(name, before == nullptr ? std::nullopt : std::optional<std::string>(before));
      ::setenv(name.c_str(), value.c_str(), 1);
    }
  }
  ~Variables() {
    for (const auto& [name, value] : former_) {
      value ? ::setenv(name.c_str(), value->c_str(), 1) : ::unsetenv(name.c_str());
    }
  }
  Variables(const Variables&) = delete;
  Variables& operator=(const Variables&) = delete;

 private:
  std::vector<std::pair<std::string, std::optional<std::string>>> former_;
};

/// Keeps all processors busy while it lives.
class Load {
 public:
  explicit Load(int processors) {
    for (int i = 0; i < processors; ++i) {
      busy_.push_back(start_program({"busy", {"/bin/sh", "-c", "while :; do :; done"}, {}, "/dev/null"}));
    }
  }
  ~Load() {
    for (const StartedProgram& program : busy_) {
      ::kill(-program.program, SIGKILL);
      ::waitpid(program.pid, nullptr, 0);
    }
  }
  Load(const Load&) = delete;
  Load& operator=(const Load&) = delete;

 private:
  std::vector<StartedProgram> busy_;
};

class PlannerCheck {
 public:
  PlannerCheck(const CheckPlannerOptions& options, const Console& console) : options_(options), console_(console) {
    base_ = options.run;
    base_.attainable = base_.report = false;
    base_.force = true;
    const FleetPlan plan = plan_fleet(base_, program_dir(), Processes::one_if_possible);
    base_.one_process = plan.options.one_process;
    duration_s_ = plan.scenario.duration_s;
    if (duration_s_ < kLeastCheck_s) {
      throw InputError("--duration " + shortest(duration_s_) + ": must be at least " + shortest(kLeastCheck_s) +
                       " s, since the second mission has a restart of " + shortest(kRestart_s) + " s");
    }
    first_uav_ = plan.scenario.fleet.front().name;
    uavs_ = plan.scenario.fleet.size();
    python_ =
        std::ranges::any_of(plan.planners, [](const auto& planner) { return python_spec(planner.spec).has_value(); });
  }

  int run() {
    const ScratchDir scratch;
    std::unique_ptr<ResultsDir> kept;
    if (options_.out) kept = ResultsDir::take_for_flights(options_.out, {}, options_.force);
    out_ = kept ? kept->path() : scratch.path();
    for (const Surroundings& one : all_surroundings(program_dir(), python_)) {
      const bool is_too_large = one.dds && uavs_ > kMostUavsOverDds;
      if (!is_as_first(one) && !is_too_large) surroundings_.push_back(one);
    }
    planned_ = kMissions * (1 + surroundings_.size());
    check("a mission", "plain", {});
    check("a mission with a restart", "restart", restart_file());
    console_.out << (differences_ == 0 ? "repeatable: all runs are the same" : "not repeatable") << std::endl;
    return differences_ == 0 ? kExitDone : kExitCheckFailed;
  }

 private:
  /// A fault file that kills and restarts an agent: the restart reveals state that outlives the process.
  fs::path restart_file() const {
    const fs::path file = out_ / "restart.yaml";
    write_file_atomically(file, "faults:\n  - {at_s: " + shortest(std::floor(duration_s_ / 3.0)) +
                                    ", for_s: " + shortest(kRestart_s) + ", kill: " + first_uav_ + "}\n");
    return file;
  }

  void check(const std::string& what, const std::string& folder, const std::optional<fs::path>& faults) {
    RunOptions run = base_;
    run.faults = faults;
    run.out = out_ / (folder + "-first");
    const Json first = fly(run);
    const std::string digest = text_in(first, "digest");
    console_.out << what << ": digest " << (digest.empty() ? "none" : digest) << std::endl;
    if (digest.empty()) {
      ++differences_;
      console_.out << "  the run did not reach its end, so there is nothing to compare\n";
      planned_ -= surroundings_.size();
      return;
    }
    run.check = false;
    for (const Surroundings& surroundings : surroundings_) compare(run, digest, folder, surroundings);
  }

  /// Whether the first run is flown in these surroundings already.
  bool is_as_first(const Surroundings& one) const {
    return one.dds && !base_.one_process && one.dds == base_.dds && one.variables.empty();
  }

  void compare(RunOptions run, const std::string& digest, const std::string& folder, const Surroundings& surroundings) {
    const fs::path first = *run.out;
    const Variables variables(surroundings.variables);
    std::optional<Load> load;
    if (surroundings.busy) load.emplace(usable_cores());
    if (surroundings.dds) {
      run.one_process = false;
      run.dds = *surroundings.dds;
    }
    run.out = out_ / (folder + "-" + surroundings.name);
    const std::string there = text_in(fly(run), "digest");
    const bool same = there == digest;
    console_.out << "  " << (same ? "same" : "DIFFERENT") << "  " << surroundings.name << ": " << surroundings.what
                 << std::endl;
    if (same) return;
    ++differences_;
    tell(run, first, surroundings);
  }

  /// Prints where the runs differ, and which programs send something else when they get the first run's recording.
  void tell(RunOptions run, const fs::path& first, const Surroundings& surroundings) {
    if (fs::exists(*run.out / run_folder::kDigests)) {
      if (const auto difference = results::first_difference(first, *run.out)) {
        console_.out << "    the runs first differ at step " << difference->step << " ("
                     << number_text(difference->time_s) << " s): " << joined(difference->fields) << '\n';
      }
    }
    run.replay = ReplayOf{first / run_folder::kRecording, std::nullopt, {}, {}};
    run.faults.reset();
    run.out = run.out->string() + "-replayed";
    ++planned_;
    for (const Json& text : value_or(fly(run), "differences", Json::array())) {
      if (text.is_string()) console_.out << "    " << text.get<std::string>() << '\n';
    }
    console_.out << "    usually it is " << surroundings.causes << std::endl;
  }

  Json fly(const RunOptions& run) {
    tell_progress();
    ++begun_;
    std::ostringstream unseen;
    if (run_fleet(run, {unseen, unseen, false}) == kExitInterrupted) throw Interrupted{};
    return read_json(*run.out / run_folder::kResult);
  }

  /// Prints which flight begins, of how many, and how long the rest will take at the pace so far.
  void tell_progress() const {
    const double wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
    console_.err << "flight " << begun_ + 1 << " of " << planned_;
    if (begun_ > 0) {
      const auto left = static_cast<double>(planned_ - begun_);
      console_.err << ", about " << duration_text(left * wall_s / static_cast<double>(begun_)) << " left";
    }
    console_.err << std::endl;
  }

  const CheckPlannerOptions& options_;
  const Console console_;
  RunOptions base_;
  double duration_s_ = 0.0;
  std::string first_uav_;
  std::size_t uavs_ = 0;
  bool python_ = false;
  fs::path out_;
  int differences_ = 0;
  std::vector<Surroundings> surroundings_;  ///< in which each mission is flown again
  std::size_t planned_ = 0, begun_ = 0;     ///< numbers of flights
  const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

}  // namespace

void add_check_planner(CLI::App& app, CheckPlannerOptions& check) {
  CLI::App* command = app.add_subcommand("check-planner",
                                         "Check that a planner is repeatable: repeat flights under other conditions "
                                         "of the machine, and name the first difference");
  const CLI::Validator seed(check_seed, ""), seconds(check_seconds, "");
  RunOptions& run = check.run;
  run.duration_s = kUsualCheck_s;
  run.seed = 1;
  command->add_option("PLANNER", run.planner, "As --planner for `skein run`")->required();
  command->add_option("--scenario", run.scenario, "A name under config/scenarios/ or a YAML file")
      ->capture_default_str();
  command->add_option("--agent", run.agent, "Agent program with planners of your own, as for `skein run`");
  command->add_option("--assets", run.assets,
                      "Folder of data files (with models/) for scenarios that need them, such as mbs");
  command->add_option("--uavs", run.uavs, "Fleet size, as for `skein run`")
      ->check(CLI::Validator(check_positive, "POSITIVE"));
  command
      ->add_option("--duration", run.duration_s,
                   fmt::format("Mission time [s], at least {:g} (default: {:g})", kLeastCheck_s, kUsualCheck_s))
      ->check(seconds);
  command->add_option("--seed", run.seed, "As for `skein run`")->check(seed)->capture_default_str();
  CLI::Option* out = command->add_option("--out", check.out, "Folder for the flights (default: Skein deletes them)");
  command->add_flag("--force", check.force, "Use a folder that is not empty, and replace the flights in it")
      ->needs(out);
  command->footer(
      "Example:\n  skein check-planner orbit --agent build/my_agent\n\n"
      "Exit codes: 0 all runs are the same, 1 a run differs. See docs/how-to-hunt.md.");
}

int check_planner(const CheckPlannerOptions& options, const Console& console) {
  return PlannerCheck(options, console).run();
}

}  // namespace skein::cli
