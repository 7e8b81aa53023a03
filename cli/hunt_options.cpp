#include "cli/hunt_options.hpp"

#include <spdlog/fmt/fmt.h>

#include <CLI/CLI.hpp>

#include "cli/option_checks.hpp"
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
  command->add_option("--duration", run.duration_s, fmt::format("Mission time [s] (default: {:g})", kUsualMission_s))
      ->check(seconds);
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
  command->add_option("--shrink", hunt.shrink, "Greatest number of flights for minimising one find")
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
                   "for later rounds, so a different number gives a different search")
      ->check(CLI::Range(std::size_t{1}, kMostRound))
      ->capture_default_str();
  add_sweep(*command, hunt.sweep);
  command->add_option("--out", hunt.out, "Folder of the hunt and its finds (default runs/hunt-<scenario>-<planner>)");
  command->add_flag("--force", hunt.force,
                    "Start a new hunt in the folder of another one, whose finds move to earlier/");
  command->add_option("--junit", hunt.junit, "File for a report as JUnit XML, for CI servers")
      ->check(CLI::Validator(check_file_to_write, ""));
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
  hunt.sweep.command = arguments;
}

}  // namespace skein::cli
