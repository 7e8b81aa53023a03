// The options of `skein contest` and `skein compare`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/sweep_options.hpp"

namespace CLI {
class App;
}

namespace skein::cli {

/// Which of a planner's totals, one per test, decides its rank.
enum class Rank { maximum, median, worst };

/// `skein contest` and `skein compare`: every planner flies every scenario with every seed.
struct StudyOptions {
  bool contest = false;                    ///< follow the contest's protocol: a test is one seed of all scenarios
  std::vector<std::string> planner_lists;  ///< values of --planners: each a list
  std::vector<std::string> planners;       ///< values of --planner: each as for `skein run`
  std::vector<std::string> scenarios;      ///< empty: the default ones
  std::string seeds = "0-4";               ///< in the format of --seeds
  Rank rank = Rank::maximum;
  std::optional<std::uint64_t> scene_seed;
  std::optional<std::string> scene_seeds;       ///< fly each scenario with each of these; format of --seeds
  std::vector<std::string> requirements;        ///< what each flight must satisfy: cli/study/requirement.hpp
  std::optional<std::filesystem::path> faults;  ///< as in RunOptions
  bool secure = false;                          ///< as in RunOptions
  std::optional<std::filesystem::path> assets;
  std::optional<double> duration_s;            ///< mission time, instead of the scenarios'
  std::optional<double> agent_timeout_s;       ///< as in RunOptions
  std::optional<std::string> rules;            ///< a preset, instead of the scenarios'
  std::vector<std::string> conditions;         ///< fly each scenario under each of these; empty: the scenarios' own
  std::vector<std::size_t> uavs;               ///< fly each scenario with each of these fleet sizes; empty: its own
  std::optional<std::string> dds;              ///< a vendor or "mixed"; none: in one process where possible
  std::optional<std::filesystem::path> agent;  ///< as in RunOptions
  std::optional<std::string> network;          ///< as in RunOptions
  std::optional<std::filesystem::path> out;
  std::string record = "none";  ///< as in RunOptions
  std::optional<int> jobs;      ///< flights at once; none: one, or as many as cores if all fly in one process
  bool force = false;
  SweepOptions sweep;
};

/// Each of these adds the command of its name, whose options CLI11 parses into the second argument.
void add_contest(CLI::App& app, StudyOptions& contest);
void add_compare(CLI::App& app, StudyOptions& study);

/// Checks and completes the parsed options. @param arguments  the whole command line
/// @throws InputError for options that do not go together.
void finish_study(StudyOptions& study, const std::vector<std::string>& arguments);

}  // namespace skein::cli
