#include "cli/bench_command.hpp"

#include <sys/utsname.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli/bench/flown.hpp"
#include "cli/bench/planners.hpp"
#include "cli/bench/profile.hpp"
#include "cli/bench/python.hpp"
#include "cli/bench/report.hpp"
#include "cli/bench/scenario.hpp"
#include "cli/bench/sensing.hpp"
#include "cli/bench/sizes.hpp"
#include "cli/bench/table.hpp"
#include "cli/bench/targets.hpp"
#include "cli/bench/tracking.hpp"
#include "cli/bench/watching.hpp"
#include "cli/option_checks.hpp"
#include "core/scenario/drawn_worlds.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "core/types.hpp"
#include "host/domain_block.hpp"
#include "host/machine.hpp"
#include "host/preflight.hpp"
#include "host/supervisor.hpp"
#include "process/files/atomic_file.hpp"
#include "process/host/environment.hpp"
#include "process/host/memory.hpp"
#include "process/program.hpp"
#include "results/run_folder.hpp"
#include "run/fleet_plan.hpp"

namespace skein::cli {
namespace {

constexpr std::size_t kFleetSize = 5, kLargeFleet = 21;  ///< fleets of kLargeFleet UAVs or more get shorter runs
constexpr std::size_t kTalkers = 20;  ///< UAVs that load the radio, unless only smaller fleets are asked for
constexpr double kExchangeS = 0.05, kOneTickS = 0.0025;
constexpr double kShortS = 600.0, kHourS = 3600.0;

/// How much is measured.
struct Effort {
  int repeats = 3;
  std::optional<double> mission_s;  ///< mission time of the speed runs; none: the scenario's own
  double scale_mission_s = 60.0, scale_mission_of_large_s = 10.0;
  int rounds = 2000, rounds_of_large = 400;
  std::vector<std::size_t> sizes = {1, 5, 10, 20, 50, 100};
  int relayed = 4000;    ///< messages sent through the router, and through the bare relay
  double load_s = 30.0;  ///< duration of the radio load in real time
};

Effort effort_of(const BenchOptions& options) {
  Effort effort;
  if (options.quick) effort = {1, 60.0, 10.0, 4.0, 400, 100, {1, 5, 20}, 500, 5.0};
  if (options.duration_s) effort.mission_s = options.duration_s;
  if (options.repeats) effort.repeats = *options.repeats;
  if (!options.sizes.empty()) effort.sizes = options.sizes;
  return effort;
}

Json machine() {
  Json machine = Json::object();
  if (const std::string cpu = cpu_model(); !cpu.empty()) machine["cpu"] = cpu;
  machine["cores"] = usable_cores();
  double load = 0.0;
  ::getloadavg(&load, 1);
  machine["load"] = load;
  utsname kernel{};
  ::uname(&kernel);
  machine["kernel"] = kernel.release;
  return machine;
}

/// One call of `skein bench`.
class Bench {
 public:
  Bench(const BenchOptions& options, const Console& console)
      : options_(options),
        effort_(effort_of(options)),
        sizes_(sizes_that_fit(effort_.sizes, memory_left(), true)),
        console_(console) {}

  int run() {
    for (const std::string& line : sizes_.said) tell(line);
    report_["machine"] = machine();
    report_["quick"] = options_.quick;
    report_["dds"] = options_.dds;
    report_["repeats"] = effort_.repeats;
    measure_speed();
    measure_rounds();
    measure_scale();
    measure_radio();
    if (options_.hour) measure_memory();
    report_["targets"] = targets_of(report_);
    print_bench(console_.out, report_);
    if (options_.json) replace_or_overwrite(*options_.json, report_.dump(2) + "\n");
    return failed_ ? kExitProcessFailed : kExitDone;
  }

 private:
  std::vector<std::string> scenarios() const {
    if (!options_.scenarios.empty()) return options_.scenarios;
    if (options_.assets) return {"towers", "mbs"};
    return {"towers"};
  }

  void measure_speed() {
    report_["speed"] = Json::array();
    for (const std::string& scenario : scenarios()) {
      RunOptions run = fleet_run(scenario, "patrol");
      run.duration_s = effort_.mission_s;
      const Flights flights = fly_all_ways(run, kFleetSize, "speed, " + scenario);
      report_["speed"].push_back(speed_entry(flights.over_dds, every_scan(run)));
      for (const auto& [threads, results] : flights.by_threads) {
        report_["speed"].push_back(speed_entry(results, nullptr, threads));
      }
    }
  }

  /// Measures all fleet sizes that fly over DDS with the chosen vendor, and the fleet of five with the other one, too.
  void measure_rounds() {
    report_["rounds"] = Json::array();
    for (const BenchSize& fleet : sizes_.fleets) {
      if (fleet.over_dds) measure_rounds_of(options_.dds, fleet.uavs);
    }
    if (!options_.quick) measure_rounds_of(options_.dds == "fastdds" ? "cyclonedds" : "fastdds", kFleetSize);
  }

  void measure_rounds_of(const std::string& vendor, std::size_t uavs) {
    const int rounds = uavs >= kLargeFleet ? effort_.rounds_of_large : effort_.rounds;
    // A hovering UAV never finishes: the number of rounds ends the run.
    RunOptions run = fleet_run(write_scenario({uavs, 600.0, kOneTickS}, "rounds"), "hover");
    run.dds = vendor;
    run.stop_at_s = rounds * kOneTickS;
    const std::string what = "rounds, " + std::to_string(uavs) + " UAVs, " + vendor;
    std::vector<RoundsPair> pairs;
    for (int i = 0; i < effort_.repeats; ++i) pairs.push_back({fly(run, what, i), floor(vendor, uavs, rounds)});
    report_["rounds"].push_back(rounds_entry(vendor, uavs, pairs));
  }

  void measure_scale() {
    report_["scale"] = Json::array();
    for (const auto& [uavs, over_dds] : sizes_.fleets) {
      const Flights flights = fly_all_ways(scale_run(uavs), uavs, "scale, " + std::to_string(uavs) + " UAVs", over_dds);
      if (over_dds) report_["scale"].push_back(scale_entry(uavs, flights.over_dds));
      for (const auto& [threads, results] : flights.by_threads) {
        report_["scale"].push_back(scale_entry(uavs, results, threads));
      }
    }
  }

  /// In the scene `towers`, all UAVs of a fleet are in radio contact. The largest fleets therefore fly in the scene
  /// `district`, which grows with the fleet.
  RunOptions scale_run(std::size_t uavs) const {
    const double mission_s = uavs >= kLargeFleet ? effort_.scale_mission_of_large_s : effort_.scale_mission_s;
    if (uavs <= kMostUavsOverDds) return fleet_run(write_scenario({uavs, mission_s, kExchangeS}, "scale"), "patrol");
    RunOptions run = fleet_run(kDistrict, "patrol");
    run.uavs = uavs;
    run.duration_s = mission_s;
    return run;
  }

  /// Measures the router's latency against a bare relay's, and a radio load: twenty UAVs that all send to all others in
  /// real time.
  void measure_radio() {
    const std::string one = write_scenario({1, 600.0, kExchangeS}, "relay");
    report_["relay"] = Json::array();
    for (const std::string vendor : {"cyclonedds", "fastdds"}) {
      std::vector<Json> reports;
      for (int i = 0; i < effort_.repeats; ++i) reports.push_back(relay(vendor, one));
      report_["relay"].push_back(relay_entry(vendor, reports));
    }
    const std::size_t uavs = std::clamp<std::size_t>(std::ranges::max(effort_.sizes), 2, kTalkers);
    RunOptions run = fleet_run(write_scenario({uavs, 600.0, kExchangeS}, "load"),
                               "exec:" + (program_dir() / "bench_chatter").string());
    run.clock = "realtime";
    run.stop_at_s = effort_.load_s;
    report_["load"] = load_entry(uavs, {fly(run, "radio load, " + std::to_string(uavs) + " UAVs", 0)});
  }

  Json relay(const std::string& vendor, const std::string& scenario) {
    const DomainBlock domains(std::nullopt, 5);
    return report_of("bench_relay", {program_dir() / "bench_relay", "--dds", vendor, "--scenario", scenario, "--router",
                                     program_dir() / programs::kCommRouter, "--out", scratch_.path(), "--messages",
                                     std::to_string(effort_.relayed), "--domain", std::to_string(domains.base())});
  }

  void measure_memory() {
    RunOptions run = fleet_run("towers", "patrol");
    run.duration_s = kShortS;
    const Json ten_minutes = fly(run, "memory, ten minutes", 0);
    run.duration_s = kHourS;
    report_["memory"] = memory_entry(ten_minutes, fly(run, "memory, an hour", 0));
  }

  RunOptions fleet_run(const std::string& scenario, const std::string& planner) const {
    RunOptions run;
    run.scenario = scenario;
    run.planner = planner;
    run.assets = options_.assets;
    run.dds = options_.dds;
    run.out = scratch_.path() / "run";
    run.force = true;
    run.attainable = run.report = false;  // not part of the flight that is measured
    return run;
  }

  std::string write_scenario(const BenchFleet& fleet, const std::string& use) const {
    const std::filesystem::path file = scratch_.path() / (use + std::to_string(fleet.uavs) + ".yaml");
    write_file_atomically(file, bench_scenario(fleet));
    return file;
  }

  struct Flights {
    std::vector<Json> over_dds;
    std::map<int, std::vector<Json>> by_threads;  ///< in one process
  };

  /// Flies over DDS (if `over_dds`), in one process with one thread, and in one with all cores, in turn, so
  /// that other load on the machine disturbs all three alike.
  Flights fly_all_ways(RunOptions run, std::size_t uavs, const std::string& what, bool over_dds = true) {
    std::set<int> ways = {1, std::min(usable_cores(), static_cast<int>(uavs))};
    Flights flights;
    for (int i = 0; i < effort_.repeats; ++i) {
      run.one_process = false;
      run.threads.reset();
      if (over_dds) flights.over_dds.push_back(fly(run, what, i));
      run.one_process = true;
      for (const int threads : ways) {
        run.threads = threads;
        flights.by_threads[threads].push_back(fly(run, what + ", " + text_of_threads(threads), i));
      }
    }
    return flights;
  }

  /// One `skein run`. @returns its result.json.
  Json fly(const RunOptions& run, const std::string& what, int repeat) {
    tell(what + ", run " + std::to_string(repeat + 1) + " of " + std::to_string(effort_.repeats));
    return cli::fly(run, what, console_.err, failed_);
  }

  /// Computes the production LiDAR's scans at all poses of the run that was just flown.
  Json every_scan(const RunOptions& run) {
    std::vector<std::string> argv = {program_dir() / "bench_lidar", "--scenario", run.scenario, "--trajectories",
                                     *run.out / run_folder::kTrajectories};
    if (run.assets) argv.insert(argv.end(), {"--assets", *run.assets});
    return report_of("bench_lidar", argv);
  }

  Json floor(const std::string& vendor, std::size_t uavs, int rounds) {
    const DomainBlock domains(std::nullopt, 2 + static_cast<int>(uavs));
    const std::string name = "bench_floor_" + vendor;
    return report_of(name, {program_dir() / name, "--uavs", std::to_string(uavs), "--rounds", std::to_string(rounds),
                            "--domain", std::to_string(domains.base())});
  }

  /// Runs a program that ends by writing one line of JSON. @returns null when it fails.
  Json report_of(const std::string& name, const std::vector<std::string>& argv) {
    const std::filesystem::path log = scratch_.path() / run_folder::log_file(name);
    const ExitStatus exit = run_to_end({name, argv, fleet_environment(false), log});
    const std::vector<std::string> last = last_lines(log, 1);
    Json report = last.empty() ? Json() : Json::parse(last.front(), nullptr, false);
    if (exit.ok() && report.is_object()) return report;
    failed_ = true;
    tell(name + " failed: " + exit.text() + (last.empty() ? "" : "\n" + last.front()));
    return nullptr;
  }

  void tell(const std::string& text) const { console_.err << "bench: " << text << std::endl; }

  const BenchOptions& options_;
  const Effort effort_;
  const BenchSizes sizes_;
  const Console console_;
  const ScratchDir scratch_;
  Json report_ = Json::object();
  bool failed_ = false;
};

}  // namespace

void add_bench(CLI::App& app, BenchOptions& bench) {
  CLI::App* command = app.add_subcommand("bench", "Measure speed, scale and memory on this machine");
  command->add_flag("--quick", bench.quick, "Measure less of everything, in less than a minute");
  command->add_flag("--hour", bench.hour,
                    "Also measure memory over an hour of simulated time; takes some minutes more");
  command->add_option("--scenario", bench.scenarios,
                      "Scenarios of the speed runs (default: towers; mbs with --assets)");
  command->add_option("--assets", bench.assets,
                      "Folder of data files (with models/) for scenarios that need them, such as mbs");
  command->add_option("--dds", bench.dds, "DDS vendor: cyclonedds or fastdds")
      ->check(CLI::IsMember({"cyclonedds", "fastdds"}))
      ->capture_default_str();
  command
      ->add_option("--sizes", bench.sizes,
                   "Fleet sizes, such as 1,5,20 (default: 1 to 100, --quick: 1 to 20); above 128, in one process only")
      ->delimiter(',')
      ->check(CLI::Range(1, static_cast<int>(kMostUavs)));
  command->add_option("--repeat", bench.repeats, "Runs of each kind; medians are reported")->check(CLI::Range(1, 100));
  command
      ->add_option("--duration", bench.duration_s,
                   "Mission time of the speed runs, or of --tracking, --view or --python [s], instead of the usual one")
      ->check(CLI::Validator(check_seconds, ""));
  command->add_option("--json", bench.json, "File for all figures")->check(CLI::Validator(check_file_to_write, ""));
  std::vector<CLI::Option*> kinds;  // of measurements: a call makes one of them
  const auto add_kind = [&](const std::string& name, bool& chosen, const std::string& text) {
    CLI::Option* kind = command->add_flag(name, chosen, text);
    for (CLI::Option* other : kinds) kind->excludes(other);
    kinds.push_back(kind);
    return kind;
  };
  CLI::Option* planners = add_kind("--planners", bench.planners,
                                   std::string("Measure the scores of ") + kBenchPlanners +
                                       " in a fixed set of scenes, and compare them with a table");
  command->add_option("--against", bench.against, "Table to compare with (default: config/planner_scores.csv)")
      ->needs(planners);
  CLI::Option* sensing =
      add_kind("--sensing", bench.sensing,
               "Measure what an explorer knows of the space around it: the tables of docs/sensing.md");
  add_kind("--tracking", bench.tracking,
           "Measure how far UAVs are from their setpoints, by speed and acceleration: the table of "
           "docs/flight-safety.md");
  add_kind("--view", bench.view,
           "Measure what the live page costs the fleet, and what the page itself needs; needs Chromium and a source "
           "tree");
  add_kind("--profile", bench.profile,
           "Measure the CPU time of an exchange by stage, and by part of each planner, for each fleet size (--sizes), "
           "and its growth; in one process, in the scenario district");
  add_kind("--python", bench.python,
           "Measure what planners in Python cost compared with C++, and what stepping, resetting and copying a fleet "
           "cost; needs a source tree");
  command
      ->add_option("--write", bench.write,
                   "File for the new table of --planners; folder for pictures and page of --sensing")
      ->each([planners, sensing](const std::string&) {
        if (planners->empty() && sensing->empty()) throw CLI::RequiresError("--write", "--planners or --sensing");
      });
  command->footer(
      "Examples:\n  skein bench --quick --json bench.json\n  skein bench --planners --write scores.csv\n"
      "  skein bench --sensing --write docs\n  skein bench --tracking --quick\n  skein bench --view\n"
      "  skein bench --profile --sizes 1,5,20,300\n  skein bench --python --assets DIR");
}

int run_bench(const BenchOptions& options, const Console& console) {
  if (options.planners) return bench_planners(options, console);
  if (options.sensing) return bench_sensing(options, console);
  if (options.tracking) return bench_tracking(options, console);
  if (options.view) return bench_watching(options, console);
  if (options.python) return bench_python(options, console);
  if (options.profile) return bench_profile(options, console);
  for (const char* program :
       {"bench_floor_cyclonedds", "bench_floor_fastdds", "bench_lidar", "bench_relay", "bench_chatter"}) {
    if (!std::filesystem::exists(program_dir() / program)) {
      throw InputError(std::string("bench: ") + program + " is not built; `./skein bench` builds it");
    }
  }
  return Bench(options, console).run();
}

}  // namespace skein::cli
