// A study: every planner flies every scenario with every seed. All that is decided before its first flight.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/options.hpp"
#include "results/result.hpp"

namespace skein::cli {

struct StudyFlight {
  std::size_t planner = 0, scenario = 0;  ///< indices in the plan
  std::uint64_t seed = 0;
  std::filesystem::path dir;
  double mission_s = 0.0;                      ///< at most
  std::optional<std::filesystem::path> agent;  ///< program that flies it; nullopt: the user named none
  bool one_process = false;                    ///< or as processes over DDS
  /// All that its result depends on but for the seed. One for all flights of a planner in a scene: it takes a kilobyte,
  /// and a study may have 100 000 flights.
  std::shared_ptr<const Json> made_under;

  /// All that its result depends on; a result that was made under the same needs no second flight.
  Json command() const;
};

struct StudyScene {
  std::string scenario;                     ///< as `skein run` takes it
  std::optional<std::uint64_t> scene_seed;  ///< nullopt: the scenario's own
  std::optional<std::string> conditions;    ///< as `skein run --conditions` takes them; nullopt: the scenario's own
};

struct StudyPlan {
  StudyOptions options;
  std::vector<std::string> planners;   ///< as `skein run --planner` takes them
  std::vector<std::string> labels;     ///< what they are called: planner_labels()
  std::vector<std::string> scenarios;  ///< what its scenes are called: "towers", "wild 7", "wild 7 harsh"
  std::vector<StudyScene> scenes;      ///< the same, as they are flown
  std::vector<std::uint64_t> seeds;
  std::filesystem::path out;         ///< absolute
  std::vector<StudyFlight> flights;  ///< by seed, then scenario, then planner: cut short, all have flown about as much
  int jobs = 1;                      ///< flights at once
  std::string medium;                ///< in or over which they fly, for people
  Json settings;                     ///< all that the results of the study depend on
  std::string command_line;          ///< that makes this study, but for how it is flown
};

/// Whether the programs themselves are asked what they think of it: it takes a while.
enum class AskPrograms { no, yes };

/// Reads everything that is named, and lets the programs themselves check every planner in every scenario.
/// @throws InputError naming what is wrong and what would be right: a planner or scenario that is unknown or named
///   twice, seeds, a missing agent program. Interrupted. Nothing is written.
StudyPlan plan_study(const StudyOptions& options, AskPrograms ask = AskPrograms::yes);

/// How two studies' settings differ, a sentence each; empty when they do not.
std::vector<std::string> differing_settings(const Json& then, const Json& now);

/// What a user types to fly the same again.
std::string repeating_command(const StudyPlan& plan, const StudyFlight& flight);

/// The `skein run` that flies it.
RunOptions flight_options(const StudyPlan& plan, const StudyFlight& flight);

}  // namespace skein::cli
