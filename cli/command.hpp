// What `skein` can be told, as plain structs.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "cli/planner_spec.hpp"

namespace skein::cli {

/// Of a film of a run.
struct FilmOptions {
  int fps = 25;
  std::optional<double> seconds;  ///< how long it is
  std::optional<double> speed;    ///< or: simulated seconds a second of it
  std::string address;            ///< what the page shows, as its address has it; a time in it is where the film begins
  int width = 1280, height = 720;
};

/// A recorded run that is flown again (recording/replay.hpp).
struct ReplayOf {
  std::filesystem::path recording;
  std::optional<double> until_s;   ///< from then on what programs say counts
  std::vector<std::string> only;   ///< UAVs whose programs take part, or "gcs"; empty: all
  std::vector<std::string> other;  ///< the same, that run other software than then: what they say is not compared
};

/// That DDS takes, of Cyclone DDS [s].
inline constexpr int kLongestLease_s = 3600;

/// What --break-on knows.
inline constexpr std::array kBreakEvents = {"collision", "rejected", "lost", "fault"};

/// What a browser is served of a run.
struct ViewOptions {
  std::optional<std::string> at;     ///< where, as view::read_endpoint() has it; none: nothing is served
  std::optional<std::string> speed;  ///< of a flight that is watched, as view::read_speed() has it
  bool close = false;                ///< the page ends with the run, instead of staying as its replay
  bool browser = true;               ///< it opens by itself where there is a browser
};

/// `skein run --place`: programs on other hosts (cli/place/).
struct PlaceOptions {
  std::optional<std::string> at;               ///< UAV=HOST,... or "slurm"; none: all programs run on this host
  std::string ssh = "ssh";                     ///< the command that logs in, with options of its own if any
  std::optional<std::filesystem::path> skein;  ///< on those hosts; else where this one is here
  bool print = false;                          ///< the commands for starting them by hand, instead of flying
};

struct RunOptions {
  std::string scenario = "towers";  ///< a name under config/scenarios/ or a YAML file
  std::string planner = kDefaultPlanner;
  std::uint64_t seed = 0;
  std::optional<std::uint64_t> scene_seed;
  std::optional<std::size_t> uavs;  ///< fleet size, instead of the scenario's
  std::optional<std::filesystem::path> assets;
  std::optional<double> duration_s;
  std::optional<std::string> rules;                 ///< a preset, instead of the scenario's
  std::optional<std::string> conditions;            ///< presets, instead of the scenario's
  std::optional<std::filesystem::path> faults;      ///< fault file
  std::string dds = "cyclonedds";                   ///< a vendor or "mixed"
  std::string clock = "lockstep";                   ///< "lockstep", "realtime" or "realtime:FACTOR"
  std::optional<std::filesystem::path> agent;       ///< program that flies in the place of uav_agent
  std::vector<std::string> debug;                   ///< UAV[=TOOL], see cli/debug/debuggee.hpp
  std::optional<double> break_at_s;                 ///< debugged programs stop before that simulated time
  std::optional<std::string> break_on;              ///< the same, before that happens to the first of them
  std::optional<std::filesystem::path> break_from;  ///< results folder of the same flight, which tells when
  std::vector<std::string> log;                     ///< UAV=LEVEL
  bool cores = false;                               ///< programs that crash leave a core
  bool one_process = false;                         ///< all programs in one process, without DDS
  std::optional<int> threads;                       ///< of that process
  bool stepped = false;                             ///< there a program steps them, and says what learners do
  bool native = false;
  bool secure = false;  ///< DDS Security, agents under user ids of their own where possible
  std::optional<int> domain;
  std::optional<std::string> ros_env;  ///< flies nothing: what a shell of this UAV's ROS 2 nodes needs is printed
  std::optional<std::string> network;  ///< other hosts take part: an interface, or "all"
  PlaceOptions place;
  std::optional<double> stop_at_s;
  std::optional<int> lease_s;             ///< of silence, after which DDS counts a program as gone
  std::optional<double> agent_timeout_s;  ///< of wall time, for a program's answer, instead of a minute
  std::optional<std::filesystem::path> out;
  bool force = false;
  std::string record = "run";         ///< how much goes into the recording: none, messages, run, all or clouds
  std::optional<double> keep_maps_s;  ///< UAVs keep their maps in time, a snapshot every so many simulated seconds
  std::optional<ReplayOf> replay;
  ViewOptions view;
  bool check = true;       ///< ask the programs first whether they can fly this
  bool attainable = true;  ///< ask the oracle after the run
  bool report = true;      ///< make report.html of the run
  double patience = 1.0;   ///< for tests: scales how long the launcher waits for programs to leave
  std::string command;     ///< as it was typed; empty: nobody typed one
};

struct TestOptions {
  bool long_tests = false;
  std::vector<std::string> folders;             ///< only what stands in these, or below: "sim_server", "tests/fleet"
  std::optional<std::filesystem::path> faults;  ///< a fault test, or a folder of them, instead of the suite
  std::vector<std::string> repeat;              ///< further runs of each fault test: names of enum Repeat
  bool rotate = false;                          ///< one of `repeat` a test, in turn
  std::filesystem::path out = "runs/faults";    ///< results of fault tests
  std::optional<std::filesystem::path> assets;
  std::optional<std::filesystem::path> agent;  ///< as in RunOptions
  bool one_process = false;                    ///< as in RunOptions
  std::optional<std::string> seeds;            ///< each test with each of these, as StudyOptions has them
  std::optional<std::filesystem::path> junit;  ///< report of fault tests for those who read XML
  int jobs = 1;                                ///< flights at once
  bool verbose = false;                        ///< tell what was seen of expectations that hold too
};

/// `skein replay`: a finished run in a browser, or two on one clock; or a file that shows them.
struct ReplayOptions {
  std::filesystem::path run;
  std::optional<std::filesystem::path> other;
  std::string at = "0";  ///< where it is served, as in ViewOptions, like the next one
  bool browser = true;
  std::optional<std::filesystem::path> exported;  ///< .html or .mp4, instead of a page that is served
  bool force = false;                             ///< overwrites it
  FilmOptions film;
  bool maps = false;  ///< compute the UAVs' maps in time first, where the folder has none
};

/// `skein fleet`: a fleet that a program steps.
struct FleetOptions {
  RunOptions run;
  int session = -1;  ///< descriptor of that program's socket
};

/// What flies a study or a hunt that is more than this process: cli/sweep/.
struct SweepOptions {
  std::optional<std::string> executor;  ///< local, parallel or slurm; none: flights are children of this process
  std::vector<std::string> logins;      ///< of parallel: hosts as ssh takes them
  std::optional<std::string> slurm;     ///< options of sbatch, as sbatch_options() has them
  bool detach = false;                  ///< give it to Slurm and end
  double unit_minutes = 5.0;            ///< of flights, in each unit
  std::optional<std::filesystem::path> status;  ///< of the study in this folder, instead of flying
  std::vector<std::string> command;             ///< words behind `skein`, as typed
};

/// `skein hunt`: a search for faults that break a property.
struct HuntOptions {
  RunOptions run;                                   ///< what is flown
  std::optional<std::string> dds;                   ///< a vendor; else in one process where that can be
  std::optional<std::filesystem::path> properties;  ///< a file of them, instead of the ready ones
  std::vector<std::string> without;                 ///< properties that are not asked
  std::vector<std::string> faults;                  ///< kinds; empty: all
  std::vector<std::string> conditions;              ///< each case under one of these; empty: the scenario's own
  std::optional<std::size_t> runs;
  std::optional<double> minutes;
  std::optional<int> jobs;
  std::uint64_t seed = 1;   ///< of the search
  bool first = false;       ///< the first find ends the search
  std::size_t shrink = 40;  ///< flights that it may take to make a find small
  std::optional<std::filesystem::path> out, junit;
  bool force = false;      ///< begin anew where another hunt was
  std::size_t round = 16;  ///< so many cases may be in the air, or not yet looked at
  SweepOptions sweep;
};

/// `skein blame`: what each fault of a run cost.
struct BlameOptions {
  std::filesystem::path what;                  ///< a results folder, or a capsule
  std::optional<std::filesystem::path> agent;  ///< as in RunOptions, like the next one
  std::optional<std::filesystem::path> assets;
  std::optional<std::string> dds;  ///< a vendor; else in one process where that can be
  std::vector<double> messages;    ///< begin and end: each link's messages are taken away, too
  std::optional<std::filesystem::path> out;
};

/// `skein check-planner`: whether its runs are the same in other surroundings.
struct CheckPlannerOptions {
  RunOptions run;
  std::optional<std::filesystem::path> out;  ///< keeps the flights
};

struct CheckOptions {
  std::vector<std::string> files;
  std::vector<std::string> golden;  ///< CSV files of reference vectors
  std::optional<std::filesystem::path> assets;
  std::optional<std::filesystem::path> agent = {};  ///< as in RunOptions
  std::string scenario = "towers";                  ///< that fault files are for, unless they name one themselves
};

struct SceneOptions {
  std::string scenario;
  std::optional<std::uint64_t> scene_seed;
  std::optional<std::filesystem::path> out;  ///< folder for its files
  bool picture = false;                      ///< a drawing: there, else in the current folder
  std::optional<std::filesystem::path> assets;
  bool force = false;
};

struct BenchOptions {
  bool quick = false;
  bool hour = false;                   ///< memory over an hour of simulated time too
  std::vector<std::string> scenarios;  ///< of the speed runs; empty: towers, and mbs with --assets
  std::optional<std::filesystem::path> assets;
  std::string dds = "cyclonedds";
  std::vector<std::size_t> sizes;  ///< of fleets; empty: the usual ones
  std::optional<int> repeats;
  std::optional<double> duration_s;  ///< mission time of the speed runs, or of those of `tracking`
  std::optional<std::filesystem::path> json;
  bool planners = false;                         ///< scores of all planners, and nothing of the machine
  bool sensing = false;                          ///< what an explorer knows, and nothing else
  bool tracking = false;                         ///< how far UAVs are from their set-points, and nothing else
  bool view = false;                             ///< what a page costs that follows a run, and nothing else
  bool python = false;                           ///< what Python costs, and nothing else
  bool profile = false;                          ///< what each stage and planner costs by the size of the fleet
  std::optional<std::filesystem::path> against;  ///< the table of scores to compare with; none: the shipped one
  std::optional<std::filesystem::path> write;    ///< where the new table goes; of sensing, a folder
};

struct OracleOptions {
  std::string scenario;
  std::optional<std::uint64_t> scene_seed;
  std::optional<std::filesystem::path> assets;
  std::optional<std::string> rules;  ///< a preset, instead of the scenario's
  std::vector<double> clearances_m;  ///< instead of the oracle's own
  bool vehicle = false;              ///< the UAVs' bodies keep them, not the cameras
  bool outside_only = false;
  bool plan = false;  ///< what full knowledge scores in the mission's time, too
  bool json = false;
};

struct DoctorOptions {
  bool net = false;  ///< who hears whom, instead of what this machine grants
  std::string scenario = "towers";
  std::optional<std::filesystem::path> assets;
  std::string dds = "cyclonedds";  ///< a vendor or "mixed"
  std::optional<int> domain;
  std::optional<std::string> network;  ///< as in RunOptions
  std::filesystem::path out = "runs";  ///< where results would go
  bool json = false;
  std::optional<std::string> name;  ///< of this host
  std::vector<std::string> only;    ///< domains in which to take part; empty: all that leave the host
  std::optional<double> seconds;    ///< to speak and listen
};

struct DiffOptions {
  std::filesystem::path run_a, run_b;
};

/// `skein compose`: a fleet in containers.
struct ComposeOptions {
  RunOptions run;
  std::optional<std::filesystem::path> file;   ///< to write to; else stdout
  std::vector<std::string> images;             ///< UAV=IMAGE, in the place of an agent's
  std::optional<std::string> subnet;           ///< "172.30.0.0/20"
  std::optional<std::filesystem::path> build;  ///< folder of a build whose programs fly
  bool up = false;                             ///< fly it
  bool stack = false;                          ///< for several engines that are one swarm
};

struct ReportOptions {
  std::vector<std::filesystem::path> runs;
};

/// What `skein rerun` and `skein fork` have in common.
struct Reflight {
  std::filesystem::path run;                   ///< its results folder
  std::optional<std::filesystem::path> agent;  ///< as in RunOptions, like the next ones
  std::optional<std::string> dds;              ///< else one process where that can be
  std::vector<std::string> debug;              ///< as in RunOptions
  std::optional<std::filesystem::path> out;    ///< else a folder in `run`
  bool force = false;
};

struct RerunOptions {
  Reflight reflight;
  std::string uav;
  std::optional<std::string> planner;  ///< instead of the one that flew
};

struct ForkOptions {
  Reflight reflight;
  double at_s = 0.0;
  std::optional<std::string> planner;  ///< "UAV=NAME,..."
};

/// This process starts a fleet's programs for a launcher on another host (cli/place/host_service.hpp).
struct HostOptions {};

/// `skein pack`: the programs with their libraries.
struct PackOptions {
  std::filesystem::path file;
  std::vector<std::filesystem::path> agents;  ///< agent programs of the user's, too
};

struct KeysOptions {
  RunOptions run;
  std::filesystem::path out;
};

struct MergeOptions {
  std::filesystem::path dir;
  std::optional<std::string> scenario;  ///< instead of what the server says that it flew
  std::optional<std::filesystem::path> assets;
  bool report = true;  ///< as in RunOptions
};

/// `skein ps`: the fleets that fly.
struct PsOptions {};

/// `skein attach`: a debugger for one of a fleet that flies.
struct AttachOptions {
  std::string what;                          ///< UAV[=TOOL], as for --debug
  std::optional<std::filesystem::path> run;  ///< results folder of its fleet; else the only one that flies
};

/// `skein --unit`: what an engine runs on a node.
struct UnitOptions {
  std::filesystem::path study;
  std::size_t unit = 0;
};

/// Which of a planner's totals over the tests decides its rank.
enum class Rank { maximum, median, worst };

/// `skein contest` and `skein compare`: every planner flies every scenario with every seed.
struct StudyOptions {
  bool contest = false;                    ///< by the contest's protocol: a test is one seed of all scenarios
  std::vector<std::string> planner_lists;  ///< of --planners: lists
  std::vector<std::string> planners;       ///< of --planner: each as `skein run` takes it
  std::vector<std::string> scenarios;      ///< empty: the usual ones
  std::string seeds = "0-4";               ///< as --seeds takes them
  Rank rank = Rank::maximum;
  std::optional<std::uint64_t> scene_seed;
  std::optional<std::string> scene_seeds;       ///< each scenario with each of these, as --seeds takes them
  std::vector<std::string> requirements;        ///< of each flight: cli/study/requirement.hpp
  std::optional<std::filesystem::path> faults;  ///< as in RunOptions
  bool secure = false;                          ///< as in RunOptions
  std::optional<std::filesystem::path> assets;
  std::optional<double> duration_s;            ///< mission time, instead of the scenarios'
  std::optional<double> agent_timeout_s;       ///< as in RunOptions
  std::optional<std::string> rules;            ///< a preset, instead of the scenarios'
  std::vector<std::string> conditions;         ///< each scenario under each of these; empty: the scenarios' own
  std::optional<std::string> dds;              ///< a vendor or "mixed"; else fleets fly in one process where they can
  std::optional<std::filesystem::path> agent;  ///< as in RunOptions
  std::optional<std::string> network;          ///< as in RunOptions
  std::optional<std::filesystem::path> out;
  std::string record = "none";  ///< as in RunOptions
  std::optional<int> jobs;      ///< flights at once; else one, or in one process each as many as there are cores
  bool force = false;
  SweepOptions sweep;
};

/// --help or --version: what to print.
struct HelpText {
  std::string text;
  bool names_planners = false;  ///< a list of the planners there are belongs below it
};

/// --complete, which a shell asks: the words up to the cursor.
struct CompletionOptions {
  std::vector<std::string> words;
};

using Command =
    std::variant<RunOptions, TestOptions, CheckOptions, SceneOptions, BenchOptions, OracleOptions, DiffOptions,
                 StudyOptions, DoctorOptions, ComposeOptions, HuntOptions, BlameOptions, CheckPlannerOptions,
                 KeysOptions, MergeOptions, ReportOptions, ReplayOptions, RerunOptions, ForkOptions, FleetOptions,
                 PsOptions, AttachOptions, UnitOptions, HostOptions, PackOptions, HelpText, CompletionOptions>;

}  // namespace skein::cli
