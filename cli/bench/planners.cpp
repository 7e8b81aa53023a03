#include "cli/bench/planners.hpp"

#include "cli/bench/planner_scores.hpp"
#include "cli/option_checks.hpp"
#include "cli/study/plan.hpp"
#include "cli/study_command.hpp"
#include "core/config/config_files.hpp"
#include "core/types.hpp"
#include "process/files/atomic_file.hpp"
#include "process/program.hpp"

namespace skein::cli {
namespace {

constexpr const char* kWorlds = "0-19";
constexpr const char* kFewWorlds = "0-4";
constexpr const char* kOut = "runs/bench-planners";

/// The families in their nominal form, and worlds in which no planner was tuned.
std::vector<StudyOptions> studies(const BenchOptions& options) {
  StudyOptions families;
  families.planner_lists = {kBenchPlanners};
  families.seeds = "0";
  families.force = true;  // the programs may have changed; flights that still fit are kept
  StudyOptions worlds = families;
  families.scenarios = bench_scenarios(options);
  families.assets = options.assets;
  families.out = std::filesystem::path(kOut) / "families";
  worlds.scenarios = {"wild"};
  worlds.scene_seeds = options.quick ? kFewWorlds : kWorlds;
  worlds.out = std::filesystem::path(kOut) / "worlds";
  return {families, worlds};
}

}  // namespace

std::vector<std::string> bench_scenarios(const BenchOptions& options) {
  std::vector<std::string> scenarios = contest_scenarios(options.assets.has_value());
  const auto procedural = static_cast<std::ptrdiff_t>(contest_scenarios(false).size());
  if (options.quick) scenarios.erase(scenarios.begin() + 1, scenarios.begin() + procedural);  // towers is the first
  return scenarios;
}

std::optional<Study> flown_study(const StudyPlan& plan, const Console& console) {
  console.err << plan.flights.size() << " flights, results in " << plan.out.string() << std::endl;
  const StudyOutcomes outcomes = fly_study(plan, console);
  return outcomes.interrupted ? std::nullopt : std::optional(study_of(plan, outcomes));
}

int bench_planners(const BenchOptions& options, const Console& console) {
  if (const std::string wrong = options.write ? check_file_to_write(*options.write) : ""; !wrong.empty()) {
    throw InputError("--write: " + wrong);
  }
  const std::filesystem::path table = options.against.value_or(default_config_dir() / "planner_scores.csv");
  const std::vector<PlannerScore> before = read_planner_scores(table);
  std::vector<PlannerScore> now;
  bool failed = false;
  for (const StudyOptions& study_options : studies(options)) {
    const StudyPlan plan = plan_study(study_options);
    const std::optional<Study> study = flown_study(plan, console);
    if (!study) return kExitInterrupted;
    failed = failed || study->any_problem();
    for (PlannerScore& score : planner_scores(*study)) now.push_back(std::move(score));
  }
  console.out << "\nbefore: " << table.string() << "\n\n";
  print_planner_scores(console.out, before, now);
  if (options.write) replace_or_overwrite(*options.write, planner_scores_csv(now));
  return failed ? kExitProcessFailed : kExitDone;
}

}  // namespace skein::cli
