// Commands and options of `skein`, as plain structs into which cli/options.hpp parses a command line: those of fleets,
// studies and hunts. Any other command has its struct in a header of its own, such as cli/scene_command.hpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "run/run_options.hpp"

namespace skein::cli {

/// Which engine flies a study or a hunt when this process does not fly it alone: cli/sweep/.
struct SweepOptions {
  std::optional<std::string> executor;  ///< local, parallel or slurm; none: flights are children of this process
  std::vector<std::string> logins;      ///< for `parallel`: hosts, as ssh accepts them
  std::optional<std::string> slurm;     ///< options of sbatch, as sbatch_options() reads them
  bool detach = false;                  ///< submit the jobs to Slurm and exit
  double unit_minutes = 5.0;            ///< approximate wall time of a unit's flights
  std::optional<std::filesystem::path> status;  ///< do not fly: print the status of the study in this folder
  std::vector<std::string> command;             ///< arguments of `skein`, as typed
};

/// `skein hunt`: a search for faults that break a property.
struct HuntOptions {
  RunOptions run;                                   ///< the flight that the hunt varies
  std::optional<std::string> dds;                   ///< a vendor or "mixed"; none: in one process where possible
  std::optional<std::filesystem::path> properties;  ///< a property file, instead of the ready ones
  std::vector<std::string> without;                 ///< properties that are not evaluated
  std::vector<std::string> faults;                  ///< kinds of faults to draw from; empty: all
  std::vector<std::string> conditions;              ///< fly each case under one of these; empty: the scenario's own
  std::optional<std::size_t> runs;
  std::optional<double> minutes;
  std::optional<int> jobs;
  std::uint64_t seed = 1;   ///< seed of the search
  bool first = false;       ///< end the search with the first find
  std::size_t shrink = 40;  ///< maximum number of flights spent on minimising a find
  std::optional<std::filesystem::path> out, junit;
  bool force = false;      ///< start over in the folder of another hunt
  std::size_t round = 16;  ///< number of cases that are drawn before the outcome of the first of them is evaluated
  SweepOptions sweep;
};

/// `skein compose`: a fleet in containers.
struct ComposeOptions {
  RunOptions run;
  std::optional<std::filesystem::path> file;   ///< file to write; none: standard output
  std::vector<std::string> images;             ///< UAV=IMAGE: replaces the image of that UAV's agent
  std::optional<std::string> subnet;           ///< network to divide: "172.30.0.0/20"
  std::optional<std::filesystem::path> build;  ///< folder of a build; its programs fly, not the images'
  bool up = false;                             ///< fly the fleet now
  bool stack = false;                          ///< a file for `docker stack`: several engines that form one swarm
};

/// This process starts a fleet's programs for a launcher on another host (cli/place/host_service.hpp).
struct HostOptions {};

struct KeysOptions {
  RunOptions run;
  std::filesystem::path out;
};

/// `skein --unit`: an engine runs this on a node, to fly one unit of a sweep.
struct UnitOptions {
  std::filesystem::path study;
  std::size_t unit = 0;
};

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

/// --help or --version: what to print.
struct HelpText {
  std::string text;
  bool names_planners = false;  ///< append a list of the available planners
};

/// --complete, which a shell calls for completion: the words up to the cursor.
struct CompletionOptions {
  std::vector<std::string> words;
};

}  // namespace skein::cli
