// The command lines of the commands that search for faults.
#include <CLI/CLI.hpp>

#include "cli/option_checks.hpp"
#include "cli/tool_options.hpp"
#include "core/text/number_checks.hpp"
#include "core/text/text.hpp"
#include "core/types.hpp"

namespace skein::cli {
namespace {

constexpr double kUsualMission_s = 120.0;

}  // namespace

void add_hunt(CLI::App& app, HuntOptions& hunt) {
  CLI::App* command =
      app.add_subcommand("hunt", "Search for faults that break a property; each find becomes a file that replays it");
  const CLI::Validator seed(check_seed, ""), seconds(check_seconds, "");
  RunOptions& run = hunt.run;
  run.duration_s = kUsualMission_s;
  command->add_option("SCENARIO", run.scenario, "A name under config/scenarios/ or a YAML file")->capture_default_str();
  command->add_option("--planner", run.planner, "As for `skein run`")->capture_default_str();
  command->add_option("--agent", run.agent, "Agent program with planners of your own, as for `skein run`");
  command->add_option("--scene-seed", run.scene_seed, "Number of the variant of a procedural scenario")->check(seed);
  command->add_option("--uavs", run.uavs, "Fleet size, as for `skein run`")
      ->check(CLI::Validator(check_positive, "POSITIVE"));
  command->add_option("--assets", run.assets,
                      "Folder of data files (with models/) for scenarios that need them, such as mbs");
  command->add_option("--duration", run.duration_s, "Mission time [s]")->check(seconds)->capture_default_str();
  command
      ->add_option("--dds", hunt.dds,
                   "Fly as processes over this DDS vendor: cyclonedds, fastdds or mixed (default: in one process where "
                   "possible, and each find again over DDS)")
      ->check(CLI::IsMember({"cyclonedds", "fastdds", "mixed"}));
  command->add_option("--properties", hunt.properties,
                      "File of the properties that must hold (default: the ready properties in docs/properties.md)");
  command->add_option("--without", hunt.without, "Properties to leave out, separated by commas")->delimiter(',');
  command->add_option("--faults", hunt.faults, "Kinds of faults to draw, separated by commas (default: all)")
      ->delimiter(',');
  command
      ->add_option("--conditions", hunt.conditions,
                   "Fly each case under one of these: none, breezy, harsh, wind=harsh+battery=breezy (default: the "
                   "scenario's own)")
      ->delimiter(',')
      ->allow_extra_args(false);
  CLI::Option* runs =
      command->add_option("--runs", hunt.runs, "Number of runs (default 200)")->check(CLI::Range(1, 1'000'000));
  command->add_option("--minutes", hunt.minutes, "Time limit [min], instead of a number of runs")
      ->check(CLI::Validator(check_positive, "POSITIVE"))
      ->excludes(runs);
  command->add_flag("--first", hunt.first, "Stop at the first find");
  command->add_option("--shrink", hunt.shrink, "Number of flights allowed for minimising a find")
      ->check(CLI::Range(0, 10'000))
      ->capture_default_str();
  command->add_option("--seed", hunt.seed, "Seed of the search; the same seed gives the same search")
      ->check(seed)
      ->capture_default_str();
  command
      ->add_option(
          "--jobs", hunt.jobs,
          "Number of simultaneous flights; the finds do not depend on it (default: the number of cores; over DDS 1)")
      ->check(CLI::Range(1, 16));
  command
      ->add_option("--round", hunt.round,
                   "Number of cases in a round, which can fly at the same time: Skein uses the results of a round only "
                   "for later rounds, so another number gives another search")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  add_sweep(*command, hunt.sweep);
  command->add_option("--out", hunt.out, "Folder of the hunt and its finds (default runs/hunt-<scenario>-<planner>)");
  command->add_flag("--force", hunt.force,
                    "Start a new hunt in the folder of another one, whose finds move to earlier/");
  command->add_option("--junit", hunt.junit, "Report for CI servers (JUnit XML)");
  command->footer(
      "Examples:\n"
      "  skein hunt towers --planner patrol --runs 500\n"
      "  skein hunt towers --planner orbit --agent build/my_agent --properties mine.yaml --minutes 30 --junit "
      "hunt.xml\n\n"
      "The same command continues a hunt that was stopped. Exit codes: 0 nothing found, 1 finds. "
      "See docs/how-to-hunt.md.");
}

void finish_hunt(HuntOptions& hunt, const std::vector<std::string>& arguments) {
  hunt.run.command = "skein " + shell_line(arguments);
  check_sweep(hunt.sweep);
  if (hunt.sweep.detach || hunt.sweep.status) {
    throw InputError("--detach and --status are of studies: a hunt decides after each round what flies next");
  }
  hunt.sweep.command = arguments;
}

void add_blame(CLI::App& app, BlameOptions& blame) {
  CLI::App* command =
      app.add_subcommand("blame", "Show what each fault of a run cost: fly again without it, and compare");
  command->add_option("RUN", blame.what, "Results folder of a run with faults, or a capsule of `skein hunt`")
      ->required();
  command->add_option("--agent", blame.agent, "Agent program with planners of your own, as for `skein run`");
  command->add_option("--assets", blame.assets,
                      "Folder of data files (with models/) for scenarios that need them, such as mbs");
  command
      ->add_option("--dds", blame.dds,
                   "Fly as processes over this DDS vendor: cyclonedds, fastdds or mixed (default: in one process where "
                   "possible)")
      ->check(CLI::IsMember({"cyclonedds", "fastdds", "mixed"}));
  command
      ->add_option("--messages", blame.messages,
                   "FROM UNTIL [s]: also fly without the messages of this time, one link after the other")
      ->expected(2);
  command->add_option("--out", blame.out,
                      "Folder of the flights (default: a new one, blame in RUN or, of a capsule, runs/blame)");
  command->add_flag("--force", blame.force, "Write to a folder that is not empty; flights there are replaced");
  command->footer(
      "Examples:\n"
      "  skein blame runs/towers-kios-0\n"
      "  skein blame runs/hunt-towers-patrol/finds/all_fly_on-17.yaml --messages 12 14\n\n"
      "See docs/how-to-hunt.md.");
}

void add_check_planner(CLI::App& app, CheckPlannerOptions& check) {
  CLI::App* command = app.add_subcommand("check-planner",
                                         "Check that a planner is repeatable: fly the same under other conditions of "
                                         "the machine, and name the first difference");
  constexpr double kShortMission_s = 40.0;
  const CLI::Validator seed(check_seed, ""), seconds(check_seconds, "");
  RunOptions& run = check.run;
  run.duration_s = kShortMission_s;
  run.seed = 1;
  command->add_option("PLANNER", run.planner, "As --planner for `skein run`")->required();
  command->add_option("--scenario", run.scenario, "A name under config/scenarios/ or a YAML file")
      ->capture_default_str();
  command->add_option("--agent", run.agent, "Agent program with planners of your own, as for `skein run`");
  command->add_option("--assets", run.assets,
                      "Folder of data files (with models/) for scenarios that need them, such as mbs");
  command->add_option("--uavs", run.uavs, "Fleet size, as for `skein run`")
      ->check(CLI::Validator(check_positive, "POSITIVE"));
  command->add_option("--duration", run.duration_s, "Mission time [s]")->check(seconds)->capture_default_str();
  command->add_option("--seed", run.seed, "As for `skein run`")->check(seed)->capture_default_str();
  CLI::Option* out = command->add_option("--out", check.out, "Folder for the flights (default: Skein deletes them)");
  command->add_flag("--force", check.force, "Write to a folder that is not empty; flights there are replaced")
      ->needs(out);
  command->footer(
      "Example:\n  skein check-planner orbit --agent build/my_agent\n\n"
      "Exit codes: 0 all runs are the same, 1 a run differs. See docs/how-to-hunt.md.");
}

}  // namespace skein::cli
