#include "cli/study_options.hpp"

#include <CLI/CLI.hpp>

#include "cli/flight_options.hpp"
#include "cli/option_checks.hpp"
#include "core/text/number_checks.hpp"

namespace skein::cli {
namespace {

/// Adds the options that `skein contest` and `skein compare` have in common.
void add_study_options(CLI::App& command, StudyOptions& study) {
  const CLI::Validator seconds(check_seconds, "");
  command
      .add_option(
          "--planners", study.planner_lists,
          "Planners to compare, separated by commas, each with parameters if you like: kios,xxh:faithful=true,star")
      ->allow_extra_args(false);
  command
      .add_option("--planner", study.planners,
                  "One more planner as for `skein run`, such as a fleet of several planners: patrol,jurong=hover")
      ->allow_extra_args(false);
  command
      .add_option("--scenarios", study.scenarios, "Names under config/scenarios/ or YAML files, separated by commas")
      ->delimiter(',')
      ->allow_extra_args(false);
  command.add_option("--assets", study.assets,
                     "Folder of data files (with models/) for scenarios that need them, such as mbs");
  command.add_option("--duration", study.duration_s, "Mission time [s], instead of the scenarios'")->check(seconds);
  command
      .add_option("--agent-timeout", study.agent_timeout_s,
                  "Wall time to wait for a program's answer before it counts as lost [s] (default 60)")
      ->check(CLI::Validator(check_timeout, ""));
  command.add_option("--rules", study.rules, "Preset of rules, instead of the scenarios': contest, paper or reference");
  command.add_option("--uavs", study.uavs, "Fly each scenario with each of these fleet sizes: 1,2,5,10")
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
                  "process where possible; the results are the same)")
      ->check(CLI::IsMember({"cyclonedds", "fastdds", "mixed"}));
  add_network(command, study.network);
  command.add_option("--agent", study.agent, "Agent program with planners of your own, as for `skein run`");
  add_record(command, study.record);
  command.add_option("--out", study.out, "Folder of flights and report (default runs/" + command.get_name() + ")");
  command
      .add_option(
          "--jobs", study.jobs,
          "Number of simultaneous flights; results do not depend on it (default: the number of cores; over DDS 1)")
      ->check(CLI::Range(1, 64));
  add_sweep_of_study(command, study.sweep);
  command.add_flag("--force", study.force,
                   "Use a folder that has a study with other settings, and keep the flights that fit");
  const bool contest = command.get_name() == "contest";
  command.footer(std::string("Example:\n  skein ") +
                 (contest ? "contest --planners kios,xxh,star --tests 3\n\n"
                          : "compare --planners kios,patrol --scenarios towers,cranes --seeds 1-5\n\n") +
                 "The same command continues a study that was stopped. See docs/how-to-compare-planners.md.");
}

}  // namespace

void add_contest(CLI::App& app, StudyOptions& contest) {
  CLI::App* command = app.add_subcommand(
      "contest", "Compare planners by the contest's protocol: tests in all scenes, totals and a ranking");
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
      ->add_option_function<std::string>(
          "--rank", set_rank, "Rank planners by their greatest total of a test (max), by the median or by the worst")
      ->check(CLI::IsMember({"max", "median", "worst"}))
      ->default_str("max");
}

void add_compare(CLI::App& app, StudyOptions& study) {
  CLI::App* command = app.add_subcommand("compare", "Compare planners over any scenes and seeds");
  add_study_options(*command, study);
  command->add_option("--seeds", study.seeds, "Seeds: a range 0-4, a list 3,5,8, or a single seed 7")
      ->capture_default_str();
  CLI::Option* const one =
      command->add_option("--scene-seed", study.scene_seed, "Number of the variant of a procedural scenario");
  one->check(CLI::Validator(check_seed, ""));
  command->add_option("--scene-seeds", study.scene_seeds, "Numbers of variants, written as for --seeds: 0-99")
      ->excludes(one);
  command->add_option("--faults", study.faults, "Fault file (YAML) for every flight");
  command->add_flag("--secure", study.secure, "Enforce the isolation of agents, as for `skein run`");
  command
      ->add_option(
          "--require", study.requirements,
          "Condition that every flight must meet: collisions==0, attainable_percent>=5, ... (else exit code 1)")
      ->allow_extra_args(false);
}

void finish_study(StudyOptions& study, const std::vector<std::string>& arguments) {
  check_sweep(study.sweep);
  study.sweep.command = arguments;
}

}  // namespace skein::cli
