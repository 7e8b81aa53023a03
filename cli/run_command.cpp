#include "cli/run_command.hpp"

#include <optional>
#include <utility>

#include "cli/oracle_command.hpp"
#include "cli/run/domain_block.hpp"
#include "cli/run/environment.hpp"
#include "cli/run/fleet_plan.hpp"
#include "cli/run/fleet_run.hpp"
#include "cli/run/losses.hpp"
#include "cli/run/preflight.hpp"
#include "cli/run/progress_view.hpp"
#include "cli/run/result.hpp"
#include "cli/run/results_dir.hpp"
#include "cli/secure/security.hpp"
#include "core/run_state.hpp"

namespace skein::cli {
namespace {

void check_before_flight(const FleetPlan& plan, const Console& console) {
  const auto users = plan.options.secure ? check_agents_access(plan) : nullptr;
  const ScratchDir scratch;
  run_checks(check_programs(plan, scratch.path(), users ? std::optional(users->at(0)) : std::nullopt),
             [&](const std::string& waiting) { console.err << waiting << std::endl; });
}

/// @param domains  none: all in one process.
std::string start_line(const FleetPlan& plan, const std::optional<DomainBlock>& domains,
                       const std::filesystem::path& out) {
  const std::string place =
      domains ? "DDS domains " + std::to_string(domains->base()) + ".." + std::to_string(domains->last())
              : "in one process";
  return plan.scenario.name + ": " + std::to_string(plan.scenario.fleet.size()) + " UAVs, planner " +
         plan.options.planner + ", seed " + std::to_string(plan.options.seed) + ", " + place + ", results in " +
         out.string();
}

/// What became of the points; a run is not worth less because of an odd file.
Json losses_of(const std::filesystem::path& dir, const Json& answer, const Reports& reports, Json& warnings) try {
  return write_losses(dir, answer, reports);
} catch (const std::exception& error) {
  warnings.push_back(std::string("no losses.csv: ") + error.what());
  return nullptr;
}

std::string text_of(const Json& result) { return result.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

/// @returns false when the disk refuses; then the result is printed, so that it is not lost.
bool write_result(const ResultsDir& out, const Json& result, std::ostream& err) {
  const std::string trouble = out.write_result(text_of(result));
  if (!trouble.empty()) err << trouble << "; this is what it would have held:\n" << text_of(result) << std::flush;
  return trouble.empty();
}

/// What the user should know of his surroundings before the run.
void warn_of_surroundings(const std::optional<DomainBlock>& domains, FleetRun& run) {
  for (const std::string& warning : environment_warnings()) {
    run.view().message("warning: " + warning);
    run.facts().warnings.push_back(warning);
  }
  if (domains && domains->last() > kLastQuietDomain) {
    run.facts().warnings.push_back("DDS domains above " + std::to_string(kLastQuietDomain) +
                                   " use ports that the system may give to other programs");
  }
}

/// What the result can do without: score.csv, and how the score compares with what could be had.
void add_score_tables(const RunOptions& options, const std::filesystem::path& dir, const Reports& reports,
                      Json& result) {
  Json& warnings = result["warnings"];
  try {
    if (!write_score_csv(dir, reports.station)) warnings.push_back("no scene.json: no score.csv");
  } catch (const std::exception& error) {
    warnings.push_back(std::string("no score.csv: ") + error.what());
  }
  if (!options.attainable || result["status"] != name_of(RunStatus::completed)) return;
  const AttainableAnswer answer = attainable_of(options);
  if (!answer.hint.empty()) warnings.push_back(answer.hint);
  if (!answer.attainable.is_object()) return;
  result["attainable"] = answer.attainable;
  result["losses"] = losses_of(dir, answer.by_point, reports, warnings);
}

int exit_code_of(FleetRun& run, const Json& result) {
  if (run.facts().interrupted) return kExitInterrupted;
  return run.anything_failed() || !result["lost_members"].empty() ? kExitProcessFailed : kExitDone;
}

}  // namespace

int run_fleet(const RunOptions& options, const Console& console) {
  const FleetPlan plan = plan_fleet(options, program_dir());
  const std::filesystem::path dir =
      options.out.value_or(default_results_dir(plan.scenario.name, options.planner, options.seed));
  ResultsDir::check(dir, options.force);
  check_before_flight(plan, console);
  std::optional<DomainBlock> domains;
  if (!options.one_process) domains.emplace(options.domain, domain_count(plan));
  const int base_domain = domains ? domains->base() : kFirstDomain;
  const ResultsDir out(dir, options.force);

  FleetRun run(plan, console.err, console.terminal);
  run.view().message(start_line(plan, domains, dir));
  warn_of_surroundings(domains, run);
  std::optional<SecureRun> secure;
  if (options.secure) {
    secure.emplace(plan, base_domain, out.path());
    for (const std::string& warning : exposed_files(plan)) {
      run.view().message(warning);
      run.facts().warnings.push_back(warning);
    }
  }
  run.fly(base_domain, out.path(), secure ? secure->folders() : SecureFolders{});

  const Reports reports = read_reports(out.path(), plan.scenario, run.reports());
  Json result = merge_result(run.facts(), plan.scenario, reports);
  // Before all that may still go wrong, or takes room.
  const bool written = write_result(out, result, console.err);
  const std::size_t warnings_written = result["warnings"].size();
  if (secure) {
    for (std::string& warning : secure->collect()) result["warnings"].push_back(std::move(warning));
  }
  secure.reset();
  add_score_tables(options, out.path(), reports, result);
  const bool news = !result["losses"].is_null() || result["attainable"]["score"].is_number() ||
                    result["warnings"].size() > warnings_written;
  if (written && news) out.write_result(text_of(result));  // the one before stands if the disk is full by now
  print_summary(console.out, result, dir);
  return written ? exit_code_of(run, result) : kExitProcessFailed;
}

}  // namespace skein::cli
