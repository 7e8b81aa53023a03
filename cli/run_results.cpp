#include "cli/run_results.hpp"

#include <utility>

#include "cli/oracle_command.hpp"
#include "core/run/run_state.hpp"
#include "process/program.hpp"
#include "report/run_report.hpp"
#include "results/losses.hpp"
#include "results/result_file.hpp"
#include "results/run_folder.hpp"
#include "results/work.hpp"
#include "run/hand_flights.hpp"
#include "run/progress_view.hpp"
#include "run/recording.hpp"
#include "run/repeat_command.hpp"

namespace skein::cli {
namespace {

/// Writes losses.csv: the causes for which score was lost. An error becomes a warning: the run is valid all the same.
Json losses_of(const std::filesystem::path& dir, const Json& answer, const results::Reports& reports,
               Json& warnings) try {
  return results::write_losses(dir, answer, reports);
} catch (const std::exception& error) {
  warnings.push_back(std::string("no losses.csv: ") + error.what());
  return nullptr;
}

/// @returns false when the result cannot be written; then it is printed, so that it is not lost.
bool write_result(const RunResults& run, const Json& result, std::ostream& err) {
  const std::string trouble = run.write(results::result_text(result));
  if (!trouble.empty())
    err << trouble << "; this is what it would have held:\n" << results::result_text(result) << std::flush;
  return trouble.empty();
}

/// Adds the optional parts: score.csv, work.csv, the attainable score and the losses. Errors become warnings.
void add_tables(const RunOptions& options, const std::filesystem::path& dir, const Scenario& scenario,
                const results::Reports& reports, Json& result) {
  Json& warnings = result["warnings"];
  try {
    if (!results::write_score_csv(dir, reports.station)) warnings.push_back("no scene.json: no score.csv");
  } catch (const std::exception& error) {
    warnings.push_back(std::string("no score.csv: ") + error.what());
  }
  try {
    results::write_work_csv(dir, scenario, reports);
  } catch (const std::exception& error) {
    warnings.push_back(std::string("no work.csv: ") + error.what());
  }
  if (!options.attainable || result["status"] != name_of(RunStatus::completed)) return;
  const AttainableAnswer answer = attainable_of(options);
  if (!answer.hint.empty()) warnings.push_back(answer.hint);
  if (!answer.attainable.is_object()) return;
  result["attainable"] = answer.attainable;
  result["losses"] = losses_of(dir, answer.by_point, reports, warnings);
}

/// Adds the command that repeats a flight in which the user flew UAVs by hand or added faults.
void tell_how_to_repeat(const RunResults& run, const std::filesystem::path& shown, Json& result) {
  if (run.facts.command.empty()) return;
  Repeated by;
  if (result.contains("hand")) {
    const auto file_of = [&](const std::string& uav) { return shown / run_folder::hand_file(uav); };
    by.planners = planners_repeated(run.options.planner, run.scenario.uav_names(), file_of);
  }
  if (std::filesystem::exists(run.dir / run_folder::kByHand)) by.faults = shown / run_folder::kByHand;
  if (by.planners || by.faults) result["repeat_command"] = command_repeated(run.facts.command, by);
}

/// Writes report.html. An error becomes a warning: the run is valid without it.
bool make_report(const std::filesystem::path& dir, Json& warnings) try {
  report::write_run_report(dir);
  return true;
} catch (const std::exception& error) {
  warnings.push_back(std::string("no report.html: ") + error.what());
  return false;
}

}  // namespace

std::optional<Json> write_results(const RunResults& run, const std::filesystem::path& shown,
                                  const std::function<std::vector<std::string>()>& collect, const Console& console) {
  Json result = results::merge_result(run.facts, run.scenario, run.reports);
  tell_how_to_repeat(run, shown, result);
  // The result is written first, because the next steps may fail, or fill the disk.
  const bool written = write_result(run, result, console.err);
  const std::size_t warnings_written = result["warnings"].size();
  for (std::string& warning : collect()) result["warnings"].push_back(std::move(warning));
  add_tables(run.options, run.dir, run.scenario, run.reports, result);
  const std::string trouble = join_recording(run.dir, run.scenario, result);
  if (!trouble.empty()) result["warnings"].push_back(trouble);
  const bool news = !result["losses"].is_null() || result["attainable"]["score"].is_number() ||
                    result["warnings"].size() > warnings_written;
  if (written && news) run.write(results::result_text(result));  // if the disk is full by now, the first one remains
  if (written && run.options.report && !make_report(run.dir, result["warnings"]))
    run.write(results::result_text(result));
  print_summary(console.out, result, shown);
  return written ? std::optional(std::move(result)) : std::nullopt;
}

int exit_code_of(FleetRun& run, const Json& result) {
  if (run.facts().interrupted) return kExitInterrupted;
  // A run that ended for no known reason counts as failed, too.
  const bool aborted = result["status"] == name_of(RunStatus::aborted);
  return run.anything_failed() || aborted || results::anyone_lost(result) ? kExitProcessFailed : kExitDone;
}

}  // namespace skein::cli
