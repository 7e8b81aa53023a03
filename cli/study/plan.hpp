// Plans a study: every planner flies every scenario with every seed.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/study_options.hpp"
#include "results/result.hpp"
#include "run/run_options.hpp"

namespace skein::cli {

struct StudyFlight {
  std::size_t planner = 0, scenario = 0;  ///< indices in the plan
  std::uint64_t seed = 0;
  std::filesystem::path dir;
  double mission_s = 0.0;                      ///< longest duration of the mission
  std::optional<std::filesystem::path> agent;  ///< agent program; nullopt: the user named none
  bool one_process = false;                    ///< false: as processes over DDS
  /// Everything on which its result depends, except the seed (made_under.hpp). It takes a kilobyte, and a study may
  /// have 100 000 flights, so all flights of a planner in a scene share one object.
  std::shared_ptr<const Json> made_under;

  /// made_under and the seed. A continued study does not repeat a flight that has a result and an equal command().
  Json command() const;
};

struct StudyScene {
  std::string scenario;                     ///< as `skein run` takes it
  std::optional<std::uint64_t> scene_seed;  ///< nullopt: the scenario's own
  std::optional<std::size_t> uavs;          ///< fleet size; nullopt: the scenario's own
  std::optional<std::string> conditions;    ///< as `skein run --conditions` takes them; nullopt: the scenario's own
};

struct StudyPlan {
  StudyOptions options;
  std::vector<std::string> planners;   ///< as `skein run --planner` takes them
  std::vector<std::string> labels;     ///< their names: planner_labels()
  std::vector<std::string> scenarios;  ///< names of the scenes: "towers", "wild 7", "wild 7 3 UAVs harsh"
  std::vector<StudyScene> scenes;      ///< the scenes, in the same order
  std::vector<std::uint64_t> seeds;
  std::filesystem::path out;         ///< absolute
  std::vector<StudyFlight> flights;  ///< by seed, scenario, planner: if interrupted, all have flown about equally often
  int jobs = 1;                      ///< flights at once
  std::string medium;                ///< how the fleets communicate, for messages: medium_of()
  Json settings;                     ///< everything on which the results of the study depend
  std::string command_line;          ///< repeats the study; without options such as --jobs
};

/// The scenarios of a contest, in its order. @param assets  whether to include the two that need CARIC's data
std::vector<std::string> contest_scenarios(bool assets);

/// Whether plan_study() starts the programs with --check to check planners and scenarios, which takes seconds.
enum class AskPrograms { no, yes };

/// Reads all files that the options name, and lets the programs check every planner in every scenario (of scenes that
/// differ only in scene seed or conditions, in the first one). Writes nothing into the study's folder.
/// @throws InputError, with a correct value: for a planner or scenario that is unknown or named twice (also by two
///   names of one file), for seeds, for a missing agent program. Interrupted.
StudyPlan plan_study(const StudyOptions& options, AskPrograms ask = AskPrograms::yes);

/// How the settings of two studies differ, in phrases for a message; empty: not at all.
std::vector<std::string> differing_settings(const Json& then, const Json& now);

/// The shell command that repeats a flight.
std::string repeating_command(const StudyPlan& plan, const StudyFlight& flight);

/// The options of the `skein run` that flies `flight`.
RunOptions flight_options(const StudyPlan& plan, const StudyFlight& flight);

}  // namespace skein::cli
