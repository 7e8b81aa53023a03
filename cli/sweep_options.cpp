#include "cli/sweep_options.hpp"

#include <CLI/CLI.hpp>
#include <charconv>

#include "core/text/number_checks.hpp"
#include "core/types.hpp"

namespace skein::cli {

void add_sweep(CLI::App& command, SweepOptions& sweep) {
  CLI::Option* executor =
      command
          .add_option("--executor", sweep.executor,
                      "Divide the flights into units of some minutes, and fly these on this machine (local), on other "
                      "hosts by GNU parallel over ssh (parallel), or on a cluster (slurm); see docs/how-to-sweep.md")
          ->check(CLI::IsMember({"local", "parallel", "slurm"}));
  command
      .add_option("--sshlogin", sweep.logins,
                  "Hosts of --executor parallel, separated by commas: [N/][USER@]HOST, where N is the number of "
                  "simultaneous units, and : for this machine")
      ->delimiter(',')
      ->allow_extra_args(false);
  command.add_option("--slurm", sweep.slurm,
                     "Options of sbatch for --executor slurm, such as partition=debug,time=30:00,account=mine");
  command.add_option("--unit-minutes", sweep.unit_minutes, "Approximate time that a unit flies [min]")
      ->check(CLI::Validator(number_within(0.01, 10000.0), ""))
      ->needs(executor)
      ->capture_default_str();
}

void add_sweep_of_study(CLI::App& command, SweepOptions& sweep) {
  add_sweep(command, sweep);
  command.add_flag("--detach", sweep.detach,
                   "With --executor slurm: do not wait for the jobs; a final job writes the report");
  command.add_option("--status", sweep.status,
                     "Show how much of the study in this folder is complete, what flies now and what failed, and write "
                     "its report so far; for studies with --executor");
}

void check_sweep(const SweepOptions& sweep) {
  const std::string executor = sweep.executor.value_or("");
  if (!sweep.logins.empty() && executor != "parallel") throw InputError("--sshlogin needs --executor parallel");
  if (sweep.slurm && executor != "slurm") throw InputError("--slurm needs --executor slurm");
  if (sweep.detach && executor != "slurm") throw InputError("--detach needs --executor slurm");
}

UnitOptions unit_options(const std::vector<std::string>& words) {
  std::size_t unit = 0;
  const std::string number = words.size() == 2 ? words[1] : "";
  const char* const end = number.data() + number.size();
  const auto read = std::from_chars(number.data(), end, unit);
  if (read.ec != std::errc() || read.ptr != end) throw InputError("--unit is for engines: --unit STUDY N");
  return {words[0], unit};
}

}  // namespace skein::cli
