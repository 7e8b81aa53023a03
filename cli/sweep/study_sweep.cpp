#include "cli/sweep/study_sweep.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cstdlib>
#include <ostream>

#include "cli/study/figures_json.hpp"
#include "cli/study_options.hpp"
#include "cli/sweep/controller.hpp"
#include "cli/sweep/engines.hpp"
#include "cli/sweep/slurm.hpp"
#include "cli/sweep/this_machine.hpp"
#include "core/types.hpp"
#include "host/machine.hpp"
#include "run/run_options.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

constexpr double kReference_s = 20.0;    ///< longest mission of the reference flight
constexpr std::size_t kUsualSlots = 64;  ///< assumed for a cluster, without --jobs
constexpr std::size_t kMostTold = 20;    ///< failed units that are listed singly

SweepFlight sweep_flight(const StudyPlan& plan, std::size_t index) {
  const StudyFlight& flight = plan.flights[index];
  return {index, flight.dir, flight_options(plan, flight), flight.command()};
}

double reference_duration_s(const StudyPlan& plan) { return std::min(plan.flights.front().mission_s, kReference_s); }

/// Candidates for the reference flight: the first flight of each planner, cut short.
std::vector<SweepFlight> references(const StudyPlan& plan, const SweepFolder& folder) {
  std::vector<SweepFlight> references;
  for (std::size_t i = 0; i < plan.flights.size() && references.size() < plan.planners.size(); ++i) {
    if (plan.flights[i].planner != references.size()) continue;
    RunOptions run = flight_options(plan, plan.flights[i]);
    run.duration_s = reference_duration_s(plan);
    run.record = "none";
    run.attainable = run.report = false;
    references.push_back({0, folder.dir() / "reference", run, plan.flights[i].command()});
  }
  return references;
}

std::size_t slots(const StudyOptions& options) {
  if (options.sweep.executor == "local") return static_cast<std::size_t>(options.jobs.value_or(usable_cores()));
  if (options.sweep.executor == "slurm") return static_cast<std::size_t>(options.jobs.value_or(kUsualSlots));
  const std::size_t hosts = std::max<std::size_t>(options.sweep.logins.size(), 1);
  return hosts * static_cast<std::size_t>(options.jobs.value_or(usable_cores()));
}

SweepPlan sweep_plan(const StudyPlan& plan, const SweepFolder& folder) {
  double mission_s = 0.0;
  for (const StudyFlight& flight : plan.flights) mission_s += flight.mission_s;
  mission_s /= static_cast<double>(plan.flights.size());
  SweepPlan sweep{plan.flights.size(),        [&plan](std::size_t index) { return sweep_flight(plan, index); },
                  references(plan, folder),   {},
                  plan.options.sweep.command, fs::current_path()};
  sweep.unit_sizes = [&plan, mission_s](double reference_s) {
    constexpr double kMinute_s = 60.0;
    const double flight_s = reference_s * mission_s / reference_duration_s(plan);
    return unit_sizes(plan.flights.size(), flight_s, kMinute_s * plan.options.sweep.unit_minutes, slots(plan.options));
  };
  return sweep;
}

StudyOutcomes outcomes_of(const StudyPlan& plan, const SweepController& controller) {
  StudyOutcomes outcomes;
  outcomes.flights.resize(plan.flights.size());
  controller.collect([&](const SweepRow& row) {
    if (row.index >= outcomes.flights.size()) return;
    StudyOutcome& outcome = outcomes.flights[row.index];
    if (row.figures.is_object()) outcome.figures = figures_from(row.figures);
    outcome.problem = row.problem;
  });
  return outcomes;
}

std::string words_of(std::size_t unit, const std::string& last_words) {
  return fmt::format("unit {} did not complete{}", unit, last_words.empty() ? "" : ": " + last_words);
}

/// Gives a problem to all flights without an outcome whose unit is not over.
void note_missing(const SweepController& controller, StudyOutcomes& outcomes) {
  const std::map<std::size_t, std::string> failed = controller.failed();
  for (std::size_t i = 0; i < outcomes.flights.size(); ++i) {
    StudyOutcome& outcome = outcomes.flights[i];
    const auto unit = failed.find(controller.settings().sizes.unit_of(i));
    if (unit == failed.end() || outcome.figures || !outcome.problem.empty()) continue;
    outcome.problem = words_of(unit->first, unit->second);
  }
}

void tell_failed(const SweepController& controller, const std::set<std::size_t>& held, std::ostream& out) {
  std::size_t told = 0;
  for (const auto& [unit, words] : controller.failed()) {
    if (held.contains(unit) || words.empty() || ++told > kMostTold) continue;
    out << words_of(unit, words) << '\n';
  }
  if (told > kMostTold) out << "and " << told - kMostTold << " more\n";
}

}  // namespace

StudyOutcomes fly_sweep(const StudyPlan& plan, const Console& console) {
  SweepFolder folder(plan.out);
  const SweepNode here = this_machine(console);
  const auto engine = make_engine(plan.options.sweep, plan.options.jobs, folder, console);
  SweepController controller(folder, *engine, here, console.err);
  controller.plan(sweep_plan(plan, folder), ::getenv(kMergeVariable) == nullptr);
  write_fly_script(folder, plan.out, fs::current_path(), plan.options.jobs);
  console.err << fmt::format("the study has {} units of up to {} flights each", controller.settings().units(),
                             controller.settings().sizes.size)
              << std::endl;
  const bool all = controller.fly();
  StudyOutcomes outcomes = outcomes_of(plan, controller);
  outcomes.detached = !all && plan.options.sweep.detach;
  outcomes.interrupted = !all && !outcomes.detached;
  if (all) {
    note_missing(controller, outcomes);
    tell_failed(controller, {}, console.err);
    for (const std::string& line : controller.findings()) console.err << line << std::endl;
  }
  return outcomes;
}

StudyOutcomes tell_sweep(const StudyPlan& plan, const Console& console) {
  SweepFolder folder(plan.out);
  const SweepNode here = this_machine(console);
  const auto engine = make_engine(plan.options.sweep, plan.options.jobs, folder, console);
  SweepController controller(folder, *engine, here, console.err);
  controller.look();
  StudyOutcomes outcomes = outcomes_of(plan, controller);
  for (const auto& [index, what] : controller.lost()) {
    if (index < outcomes.flights.size())
      outcomes.flights[index] = {std::nullopt, what + "; Skein flies it again when you continue the study"};
  }
  const std::vector<EngineJob> jobs = engine->jobs();
  std::set<std::size_t> held;
  for (const EngineJob& job : jobs) held.insert(job.unit);
  const auto there =
      std::ranges::count_if(outcomes.flights, [](const StudyOutcome& o) { return o.figures.has_value(); });
  const std::size_t units = controller.settings().units(), open = controller.failed().size();
  console.out << fmt::format("{} of {} flights are complete; {} of {} units have ended, {} are queued or running\n",
                             there, plan.flights.size(), units - open, units, held.size());
  for (std::size_t i = 0; i < std::min(jobs.size(), kMostTold); ++i) {
    console.out << fmt::format("unit {}: {}\n", jobs[i].unit, jobs[i].state);
  }
  if (jobs.size() > kMostTold) console.out << "and " << jobs.size() - kMostTold << " more\n";
  tell_failed(controller, held, console.out);
  for (std::size_t i = 0, told = 0; i < outcomes.flights.size() && told < kMostTold; ++i) {
    if (outcomes.flights[i].problem.empty()) continue;
    console.out << plan.flights[i].dir.string() << ": " << outcomes.flights[i].problem << '\n';
    ++told;
  }
  for (const std::string& line : controller.findings()) console.out << line << '\n';
  return outcomes;
}

std::vector<std::string> enter_sweep(const fs::path& study) {
  const SweepFolder folder(fs::absolute(study));
  const auto settings = folder.settings();
  if (!settings) throw InputError("--status " + study.string() + ": " + folder.why_no_settings());
  fs::current_path(settings->working_folder);
  return settings->command;
}

}  // namespace skein::cli
