#include "cli/study_command.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <memory>
#include <utility>

#include "cli/command_line.hpp"
#include "cli/study/columns.hpp"
#include "cli/study/conditions_table.hpp"
#include "cli/study/csv.hpp"
#include "cli/study/figure_files.hpp"
#include "cli/study/page.hpp"
#include "cli/study/pairs.hpp"
#include "cli/study/requirement.hpp"
#include "cli/study/tex.hpp"
#include "cli/study/worlds.hpp"
#include "cli/sweep/slurm.hpp"
#include "cli/sweep/study_sweep.hpp"
#include "core/text/sha256.hpp"
#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "core/types.hpp"
#include "host/machine.hpp"
#include "process/files/atomic_file.hpp"
#include "process/program.hpp"
#include "report/html.hpp"
#include "results/run_folder.hpp"
#include "run/results_dir.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;
using report::shortened;

constexpr const char* kSettings = "study.json";
constexpr std::size_t kLongestName = 40;   ///< longest name of a planner on the terminal, in characters
constexpr std::size_t kMostPictured = 20;  ///< a study of more scenes gets no pictures
/// Scores over time and deliveries are read for the page only in studies of at most so many flights: more take minutes.
constexpr std::size_t kMostWithTables = 5000;

/// A study writes only to a folder of its own, unless --force is given.
/// @throws InputError when the folder holds files that are neither of a study nor logs.
void check_is_of_a_study(const fs::path& out) {
  std::error_code error;  // ignored: ResultsDir reports what cannot be looked at
  if (!fs::is_directory(out, error) || fs::exists(out / kSettings, error)) return;
  if (fs::exists(out / run_folder::kResult, error)) {
    throw InputError(out.string() + " holds a result already, and no study; choose another --out");
  }
  const std::string first = foreign_entry(out);
  if (first.empty()) return;
  throw InputError("--out " + out.string() + ": '" + first +
                   "' exists and belongs to no study; choose another --out, or use this folder anyway with --force");
}

/// @returns why the study in the plan's folder is not the one that the plan describes; empty: it is, or there is none.
std::string difference_from_folder(const StudyPlan& plan) {
  std::error_code error;
  if (!fs::exists(plan.out / kSettings, error)) return {};
  const Json then = read_json(plan.out / kSettings);
  if (!then.is_object()) return (plan.out / kSettings).string() + ": is damaged: it is not JSON";
  const std::vector<std::string> differences = differing_settings(then, plan.settings);
  if (differences.empty()) return {};
  std::string text = plan.out.string() + " holds a study with other settings:";
  for (const std::string& difference : differences) text += "\n  " + difference;
  return text;
}

/// @throws InputError when the folder holds a study with other settings, unless --force is given.
void check_settings(const StudyPlan& plan) {
  const std::string difference = plan.options.force ? "" : difference_from_folder(plan);
  if (difference.empty()) return;
  throw InputError(difference +
                   "\nNothing was changed. Choose another --out, or continue there with --force: flights that fit are "
                   "kept, and the others are flown again in their place.");
}

/// The same for `--status`, whose report names the present programs. It does not matter whether the command with which
/// the study was flown had --force.
void check_shown_settings(const StudyPlan& plan) {
  const std::string difference = difference_from_folder(plan);
  if (difference.empty()) return;
  throw InputError(difference +
                   "\nNothing was changed: --status only shows a study, and needs the programs and files with which it "
                   "was flown. Call it with these. If you continue the study with the present ones instead (repeat "
                   "its command with --force), Skein keeps the flights that fit, and flies the others again in their "
                   "place. No flight fits after the programs were built anew.");
}

/// A picture of the best flight of each scene and planner; none in a study of too many scenes to look at.
StudyPictures pictures_of(const Study& study) {
  StudyPictures pictures;
  if (study.scenarios.size() > kMostPictured) return pictures;
  for (std::size_t s = 0; s < study.scenarios.size(); ++s) {
    for (std::size_t p = 0; p < study.planners.size(); ++p) {
      if (const FlightEntry* best = study.best(p, s))
        pictures.emplace(std::pair(s, p), report::read_picture(best->dir));
    }
  }
  return pictures;
}

/// Removes the figures of an earlier study in this folder, which would be mistaken for this one's, and writes the new.
void write_figures(const StudyReport& report, const fs::path& dir) {
  fs::create_directories(dir);
  for (const fs::directory_entry& entry : fs::directory_iterator(dir)) {
    if (entry.path().extension() == ".svg") fs::remove(entry.path());
  }
  for (const StudyFigure& figure : report.figures) write_file_atomically(dir / figure.file, paper_svg(figure));
}

void write_report(const Study& study, const fs::path& out) {
  write_file_atomically(out / "flights.csv", flights_csv(study));
  write_file_atomically(out / "summary.csv", summary_csv(study));
  if (study.contest) write_file_atomically(out / "totals.csv", totals_csv(study));
  const StudyReport report(study, pictures_of(study));
  std::vector<PlannerPair> pairs = report.pairs;
  std::ranges::move(other_pairs(study), std::back_inserter(pairs));
  write_file_atomically(out / "pairs.csv", pairs_csv(study, pairs));
  write_file_atomically(out / kTexTable, study_tex(study, report.pairs, report.titles));
  write_figures(report, out / kFiguresFolder);
  write_file_atomically(out / run_folder::kPage, study_page(report));
}

std::string machine_text() {
  const std::string cpu = cpu_model();
  return (cpu.empty() ? "an unknown processor" : cpu) +
         fmt::format(", {} cores, {:.0f} GB of memory", usable_cores(), memory_gb());
}

std::string range_text(const Spread& spread, int digits) {
  return fixed(spread.median, digits) + " (" + fixed(spread.min, digits) + "-" + fixed(spread.max, digits) + ")";
}

}  // namespace

Study study_of(const StudyPlan& plan, StudyOutcomes outcomes) {
  Study study{plan.options.contest,
              plan.options.rank,
              plan.labels,
              plan.scenarios,
              plan.seeds,
              {},
              plan.command_line,
              plan.settings["skein_version"],
              Sha256().add(plan.settings["programs"].dump() + plan.settings["agents"].dump()).hex(),
              plan.medium,
              plan.jobs};
  std::vector<std::string> conditions;
  if (plan.options.duration_s) conditions.push_back(fmt::format("missions of {} s", *plan.options.duration_s));
  if (plan.options.scene_seed) conditions.push_back(fmt::format("scene seed {}", *plan.options.scene_seed));
  if (plan.options.rules) conditions.push_back("rules " + *plan.options.rules);
  if (plan.options.faults) conditions.push_back("faults of " + plan.options.faults->string());
  study.conditions = joined(conditions);
  study.machine = machine_text();
  for (const StudyScene& scene : plan.scenes) {
    if (scene.conditions) study.scene_conditions.push_back(*scene.conditions);
  }
  for (std::size_t i = 0; i < plan.flights.size(); ++i) {
    const StudyFlight& flight = plan.flights[i];
    StudyOutcome& outcome = outcomes.flights[i];
    FlightEntry entry{flight.planner, flight.scenario, flight.seed,
                      flight.dir,     std::nullopt,    std::move(outcome.problem)};
    entry.command = repeating_command(plan, flight);
    entry.folder = flight.dir.lexically_relative(plan.out).generic_string();
    entry.figures = std::exchange(outcome.figures, std::nullopt);
    if (entry.figures && plan.flights.size() <= kMostWithTables) entry.tables = read_flight_tables(flight.dir);
    if (fs::exists(flight.dir / run_folder::kPage)) {
      entry.page = (flight.dir / run_folder::kPage).lexically_relative(plan.out).generic_string();
    }
    study.flights.push_back(std::move(entry));
  }
  return study;
}

void print_study(std::ostream& out, const Study& study) {
  const auto name_of = [&](std::size_t planner) { return shortened(study.planners[planner], kLongestName); };
  if (study.contest) {
    out << fmt::format("\n{:<7}{:<42}{:>12}   {}\n", "place", "planner", rank_name(study.rank) + " total",
                       "totals by test");
    for (const Standing& standing : standings(study)) {
      std::string totals;
      for (const std::optional<double>& total : standing.totals) totals += "  " + (total ? fixed(*total, 1) : "-");
      out << fmt::format("{:<7}{:<42}{:>12} {}\n", standing.decides ? std::to_string(standing.place) : "-",
                         name_of(standing.planner), standing.decides ? fixed(*standing.decides, 1) : "-", totals);
    }
  }
  const StudyColumn& score = study_columns().front();
  for (std::size_t s = 0; s < study.scenarios.size(); ++s) {
    out << fmt::format("\n{:<49}{:>28}{:>12}{:>12}\n", study.scenarios[s], "score", "points", "collisions");
    for (std::size_t p = 0; p < study.planners.size(); ++p) {
      const auto flights = study.cell(p, s);
      std::vector<double> points;
      int collisions = 0;
      for (const FlightEntry* flight : flights) {
        points.push_back(flight->figures->points_detected);
        collisions += flight->figures->collisions;
      }
      out << fmt::format("  {:<47}{:>28}{:>12}{:>12}\n", name_of(p),
                         flights.empty() ? "no flight" : range_text(spread_of(column_values(score, flights)), 1),
                         fixed(spread_of(points).median, 0), collisions);
    }
  }
  out << "\nmedians over the seeds, and the range from minimum to maximum; collisions: sum over all flights\n";
}

namespace {

/// Writes and prints the report of the flights so far. @returns the exit code.
int merge(const StudyPlan& plan, StudyOutcomes outcomes, const Console& console) {
  std::vector<Requirement> requirements;
  for (const std::string& text : plan.options.requirements) requirements.push_back(parse_requirement(text));
  const bool interrupted = outcomes.interrupted;
  const Study study = study_of(plan, std::move(outcomes));
  write_report(study, plan.out);
  if (plan.options.scene_seeds) {
    print_worlds(console.out, study);
  } else {
    print_study(console.out, study);
    print_pairs(console.out, study, planner_pairs(study));
  }
  print_conditions(console.out, study);
  const bool kept = print_requirements(console.out, study, requirements);
  console.out << "report: " << (plan.out / run_folder::kPage).string() << std::endl;
  if (interrupted) {
    console.err << "interrupted; the same command continues from here" << std::endl;
    return kExitInterrupted;
  }
  if (study.any_problem()) return kExitProcessFailed;
  return kept ? kExitDone : kExitCheckFailed;
}

/// Locks the results folder. @returns null if this is the merge job at the end of a detached study, and another program
/// that follows the study holds the folder.
std::unique_ptr<ResultsDir> results_dir(const fs::path& dir) try {
  return std::make_unique<ResultsDir>(dir, Earlier::keep);
} catch (const FolderInUse&) {
  if (std::getenv(kMergeVariable) == nullptr) throw;
  return nullptr;
}

/// `--status`: prints the progress of a study, and merges the flights so far.
int tell_status(const fs::path& folder, const Console& console) {
  const Command command = parse_command_line(enter_sweep(folder));
  const auto* options = command.get_if<StudyOptions>();
  if (options == nullptr) throw InputError("--status " + folder.string() + ": this is not a study");
  const StudyPlan plan = plan_study(*options, AskPrograms::no);
  check_shown_settings(plan);
  return merge(plan, tell_sweep(plan, console), console);
}

}  // namespace

int run_study(const StudyOptions& options, const Console& console) {
  if (options.sweep.status) return tell_status(*options.sweep.status, console);
  for (const std::string& text : options.requirements) parse_requirement(text);
  const StudyPlan plan = plan_study(options);
  check_settings(plan);
  if (!options.force) check_is_of_a_study(plan.out);
  const auto out = results_dir(plan.out);
  if (!out) {
    console.out << "another program follows this study, and merges it" << std::endl;
    return kExitDone;
  }
  write_file_atomically(plan.out / kSettings, json_text(plan.settings, 2) + "\n");
  console.err << plan.flights.size() << " flights, results in " << plan.out.string() << std::endl;

  StudyOutcomes outcomes = options.sweep.executor ? fly_sweep(plan, console) : fly_study(plan, console);
  return outcomes.detached ? kExitDone : merge(plan, std::move(outcomes), console);
}

}  // namespace skein::cli
