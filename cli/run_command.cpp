#include "cli/run_command.hpp"

#include <optional>

#include "cli/run/domain_block.hpp"
#include "cli/run/environment.hpp"
#include "cli/run/fleet_plan.hpp"
#include "cli/run/fleet_run.hpp"
#include "cli/run/preflight.hpp"
#include "cli/run/results_dir.hpp"
#include "cli/run_results.hpp"
#include "cli/secure/security.hpp"

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
  const auto collect = [&] { return secure ? secure->collect() : std::vector<std::string>(); };
  const RunResults results{options, run.facts(), plan.scenario,
                           reports, out.path(),  [&](const std::string& text) { return out.write_result(text); }};
  const auto result = write_results(results, dir, collect, console);
  return result ? exit_code_of(run, *result) : kExitProcessFailed;
}

}  // namespace skein::cli
