// The command lines of studies, and the options for flying them beyond one process.
#include <CLI/CLI.hpp>
#include <charconv>

#include "cli/option_checks.hpp"
#include "cli/tool_options.hpp"
#include "core/text/number_checks.hpp"
#include "core/types.hpp"

namespace skein::cli {

void add_sweep(CLI::App& command, SweepOptions& sweep) {
  command
      .add_option("--executor", sweep.executor,
                  "Fly it in units of some minutes: local, here; parallel, by GNU parallel over ssh; slurm, as a job "
                  "array (docs/sweeps.md)")
      ->check(CLI::IsMember({"local", "parallel", "slurm"}));
  command
      .add_option("--sshlogin", sweep.logins,
                  "Hosts of --executor parallel, with commas between: [N/][USER@]HOST, and : for this one")
      ->delimiter(',')
      ->allow_extra_args(false);
  command.add_option("--slurm", sweep.slurm,
                     "Options of sbatch for --executor slurm: partition=debug,time=30:00,account=mine");
  command.add_flag("--detach", sweep.detach, "With --executor slurm: do not wait; a job at the end writes the report");
  command.add_option("--unit-minutes", sweep.unit_minutes, "About so long a unit flies")
      ->check(CLI::Validator(number_within(0.01, 10000.0), ""))
      ->capture_default_str();
  command.add_option("--status", sweep.status,
                     "What is there of the study in this folder, what flies, what failed; and its report so far");
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

void add_pack(CLI::App& app, PackOptions& pack) {
  CLI::App* command =
      app.add_subcommand("pack", "Write the programs with all their libraries into one archive, for other machines");
  command->add_option("FILE", pack.file, "The archive: skein.tar.gz")->required();
  command->add_option("--agent", pack.agents, "Agent program of yours, to be packed, too")->allow_extra_args(false);
  command->footer("Example:\n  skein pack skein.tar.gz\n\ndocs/sweeps.md has more.");
}

namespace {

/// Adds the options that `skein contest` and `skein compare` have in common.
void add_study_options(CLI::App& command, StudyOptions& study) {
  const CLI::Validator seconds(check_seconds, "");
  command.add_option("--planners", study.planner_lists, "A,B,... with parameters if any: kios,xxh:faithful=true,star")
      ->allow_extra_args(false);
  command.add_option("--planner", study.planners, "One more, as for `skein run`: fleets of several, any command")
      ->allow_extra_args(false);
  command
      .add_option("--scenarios", study.scenarios, "Names under config/scenarios/ or YAML files, with commas between")
      ->delimiter(',')
      ->allow_extra_args(false);
  command.add_option("--assets", study.assets, "Folder with models/ for scenarios that read files");
  command.add_option("--duration", study.duration_s, "Mission time [s], instead of the scenarios'")->check(seconds);
  command
      .add_option("--agent-timeout", study.agent_timeout_s,
                  "Wall time to wait for a program's answer before it counts as lost [s] (default 60)")
      ->check(seconds);
  command.add_option("--rules", study.rules, "Preset of rules, instead of the scenarios': contest, paper or reference");
  command
      .add_option("--uavs", study.uavs,
                  "Fly each scenario with each of these fleet sizes: 1,2,5,10; as for `skein run`")
      ->check(CLI::Validator(check_positive, "POSITIVE"))
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      .add_option("--conditions", study.conditions,
                  "Fly each scenario under each of these: none, breezy, harsh, wind=harsh+battery=breezy")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      .add_option("--dds", study.dds,
                  "Fly as processes over this DDS vendor: cyclonedds, fastdds or mixed (default: each fleet in one "
                  "process where it can; the results are the same)")
      ->check(CLI::IsMember({"cyclonedds", "fastdds", "mixed"}));
  add_network(command, study.network);
  command.add_option("--agent", study.agent, "Agent program with planners of your own, as for `skein run`");
  add_record(command, study.record);
  command.add_option("--out", study.out, "Folder of flights and report (default runs/" + command.get_name() + ")");
  command
      .add_option("--jobs", study.jobs,
                  "Flights at once; results do not depend on it (default: as many as cores, over DDS one)")
      ->check(CLI::Range(1, 64));
  add_sweep(command, study.sweep);
  command.add_flag("--force", study.force, "Go on in a folder of other settings; flights that fit are kept");
  const bool contest = command.get_name() == "contest";
  command.footer(std::string("Example:\n  skein ") +
                 (contest ? "contest --planners kios,xxh,star --tests 3\n\n"
                          : "compare --planners kios,patrol --scenarios towers,cranes --seeds 1-5\n\n") +
                 "The same command again goes on where it was stopped. docs/how-to-compare-planners.md has more.");
}

}  // namespace

void add_contest(CLI::App& app, StudyOptions& contest) {
  CLI::App* command =
      app.add_subcommand("contest", "The contest's protocol: tests of all scenes, totals and a ranking");
  contest.contest = true;
  contest.seeds = "1-5";
  add_study_options(*command, contest);
  const auto set_tests = [&contest](int tests) { contest.seeds = "1-" + std::to_string(tests); };
  command->add_option_function<int>("--tests", set_tests, "Number of tests; test N is seed N of every scene")
      ->check(CLI::Range(1, 1000))
      ->default_str("5");
  const auto set_rank = [&contest](const std::string& by) {
    contest.rank = by == "max" ? Rank::maximum : by == "median" ? Rank::median : Rank::worst;
  };
  command
      ->add_option_function<std::string>("--rank", set_rank,
                                         "By the greatest total of a test (max), the median or the worst")
      ->check(CLI::IsMember({"max", "median", "worst"}))
      ->default_str("max");
}

void add_compare(CLI::App& app, StudyOptions& study) {
  CLI::App* command = app.add_subcommand("compare", "Planners side by side over any scenes and seeds");
  add_study_options(*command, study);
  command->add_option("--seeds", study.seeds, "Which seeds: 0-4, 3,5,8 or one, such as 7")->capture_default_str();
  CLI::Option* const one = command->add_option("--scene-seed", study.scene_seed, "Which scene of a procedural family");
  one->check(CLI::Validator(check_seed, ""));
  command->add_option("--scene-seeds", study.scene_seeds, "Many scenes of a family, as --seeds has them: 0-99")
      ->excludes(one);
  command->add_option("--faults", study.faults, "Fault file: what goes wrong in every flight");
  command->add_flag("--secure", study.secure, "DDS Security, as for `skein run`");
  command
      ->add_option("--require", study.requirements,
                   "What every flight must keep: collisions==0, attainable_percent>=5, ...")
      ->allow_extra_args(false);
}

}  // namespace skein::cli
