#include "cli/bench/python.hpp"

#include <spdlog/fmt/fmt.h>

#include <optional>
#include <string>

#include "cli/bench/flown.hpp"
#include "cli/bench/report.hpp"
#include "core/config/config_files.hpp"
#include "core/files/command_file.hpp"
#include "core/types.hpp"
#include "host/preflight.hpp"
#include "host/supervisor.hpp"
#include "process/files/atomic_file.hpp"
#include "process/host/environment.hpp"
#include "process/program.hpp"
#include "results/run_folder.hpp"
#include "run/fleet_plan.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSteppingScript = "stepping.py";
constexpr const char* kOneProcessMedium = "one process";
constexpr const char* kDdsMedium = "over DDS";

/// Number and length [s] of the flights and of the stepped runs.
struct PythonEffort {
  int pairs = 5;
  double flight_s = 200.0;
  int steppings = 3;
  double stepped_s = 60.0;
  int resets = 1000, copies = 20;
  double copy_at_s = 300.0;
};

PythonEffort python_effort(const BenchOptions& options) {
  PythonEffort effort;
  if (options.quick) effort = {1, 20.0, 1, 5.0, 20, 3, 10.0};
  if (options.duration_s) effort.flight_s = *options.duration_s;
  if (options.repeats) effort.pairs = effort.steppings = *options.repeats;
  return effort;
}

/// The programs and files that the benchmark needs.
struct PythonTools {
  fs::path python, package, planner, stepping;
};

PythonTools find_python_tools() {
  const fs::path tree = fs::weakly_canonical(default_config_dir() / "..") / "python";
  const fs::path debian = "/usr/bin/python3";  // which has Debian's NumPy
  const PythonTools tools{fs::exists(debian) ? debian : command_file("python3"), tree, tree / "examples/hover.py",
                          tree / "bench" / kSteppingScript};
  if (tools.python.empty()) throw InputError("bench --python: there is no Python: apt-get install python3-numpy");
  for (const fs::path& needed : {tools.planner, tools.stepping}) {
    if (!fs::exists(needed)) {
      throw InputError("bench --python: " + needed.string() + " is missing: it needs the source tree");
    }
  }
  return tools;
}

class PythonBench {
 public:
  PythonBench(const BenchOptions& options, const Console& console)
      : options_(options), effort_(python_effort(options)), console_(console), tools_(find_python_tools()) {}

  int run() {
    const Json planners = {{kOneProcessMedium, fly_pairs(true)}, {kDdsMedium, fly_pairs(false)}};
    const Json stepping = step_fleets();
    const Json rows = python_rows(planners, stepping);
    print_python(console_.out, rows);
    if (options_.json) {
      const Json report = {{"planners", planners}, {"stepping", stepping}, {"rows", rows}};
      replace_or_overwrite(*options_.json, report.dump(2) + "\n");
    }
    return failed_ ? kExitProcessFailed : kExitDone;
  }

 private:
  /// Flies in C++ and in Python alternately, so that other load of the machine affects both alike.
  Json fly_pairs(bool one_process) {
    std::vector<LanguagePair> pairs;
    for (int i = 0; i < effort_.pairs; ++i) {
      console_.err << fmt::format("bench: hover in C++ and in Python, {}, {} of {}",
                                  one_process ? kOneProcessMedium : kDdsMedium, i + 1, effort_.pairs)
                   << std::endl;
      const Json cpp = fly("hover", one_process);
      pairs.push_back({cpp, fly("py:" + tools_.planner.string(), one_process)});
    }
    return language_pairs_entry(pairs);
  }

  Json fly(const std::string& planner, bool one_process) {
    RunOptions run;
    run.scenario = options_.scenarios.empty() ? "towers" : options_.scenarios.front();
    run.planner = planner;
    run.assets = options_.assets;
    run.dds = options_.dds;
    run.duration_s = effort_.flight_s;
    run.one_process = one_process;
    run.record = "none";
    run.out = scratch_.path() / "run";
    run.force = true;
    run.attainable = run.report = false;
    return cli::fly(run, planner, console_.err, failed_);
  }

  /// @returns the lists of stepping.py, or an empty object when it failed.
  Json step_fleets() {
    const fs::path log = scratch_.path() / run_folder::log_file(kSteppingScript);
    const fs::path figures = scratch_.path() / "stepping.json";
    const std::vector<std::string> argv = {tools_.python,
                                           "-B",
                                           tools_.stepping,
                                           "--repeat",
                                           std::to_string(effort_.steppings),
                                           "--seconds",
                                           fmt::format("{}", effort_.stepped_s),
                                           "--resets",
                                           std::to_string(effort_.resets),
                                           "--copies",
                                           std::to_string(effort_.copies),
                                           "--copy-at",
                                           fmt::format("{}", effort_.copy_at_s),
                                           "--json",
                                           figures,
                                           "--copied",
                                           options_.assets ? "towers,mbs" : "towers"};
    std::map<std::string, std::string> variables = {{"PYTHONPATH", tools_.package}, {"SKEIN", program_dir() / "skein"}};
    if (options_.assets) variables["SKEIN_ASSETS"] = fs::absolute(*options_.assets);
    console_.err << "bench: fleets that Python steps, resets and copies" << std::endl;
    const ExitStatus exit = run_to_end({kSteppingScript, argv, fleet_environment(false, variables), log});
    if (exit.ok() && fs::exists(figures)) return read_json(figures);
    failed_ = true;
    console_.err << "bench: " << kSteppingScript << " failed: " << exit.text() << '\n';
    for (const std::string& line : last_lines(log, 20)) console_.err << line << '\n';
    return Json::object();
  }

  const BenchOptions& options_;
  const PythonEffort effort_;
  const Console console_;
  const PythonTools tools_;
  const ScratchDir scratch_;
  bool failed_ = false;
};

struct Row {
  const char* key;  ///< in the output of stepping.py
  const char* name;
  std::optional<double> target;
  bool at_least;
  int digits;
};

constexpr Row kSteppingRows[] = {
    {"stepping_cpu", "steps of 0.05 s, five learners, no scans: times real time, by CPU time", 100.0, true, 1},
    {"stepping_clock", "  by the clock", {}, true, 1},
    {"stepping_python_us", "  CPU time of a step in Python [us]", {}, false, 0},
    {"stepping_fleet_us", "  CPU time of a step in the fleet [us]", {}, false, 0},
    {"stepping_safe_cpu", "the same with the safety filter, so with all scans, by CPU time", {}, true, 1},
    {"stepping_safe_clock", "  by the clock", {}, true, 1},
    {"resets_per_minute_cpu", "resets a minute to the first observation, by CPU time", 1000.0, true, 0},
    {"resets_per_minute_clock", "  by the clock", {}, true, 0},
    {"growth_here_mb", "growth of Python's memory over these resets [MB]", 1.0, false, 2},
    {"growth_root_mb", "growth of the copied process over these resets [MB]", 1.0, false, 2},
    {"copy_towers_clock_ms", "a copy of a fleet in towers [ms], by the clock", {}, false, 1},
    {"copy_towers_cpu_ms", "  CPU time of all three processes [ms]", {}, false, 1},
    {"copy_mbs_clock_ms", "a copy of a fleet beside MBS [ms], by the clock", 20.0, false, 1},
    {"copy_mbs_cpu_ms", "  CPU time of all three processes [ms]", {}, false, 1},
    {"copy_mbs_mb", "  memory of the fleet that is copied [MB]", {}, false, 0},
};

Json row_of(const Row& row, const Json& figure) {
  Json json = {{"name", row.name}, {"digits", row.digits}, {"kind", row.at_least ? "at_least" : "at_most"}};
  json["figure"] = figure;
  json["target"] = row.target ? Json(*row.target) : Json();
  const double median = number_in(figure, "median");
  json["met"] = row.target ? Json(row.at_least ? median >= *row.target : median <= *row.target) : Json();
  return json;
}

}  // namespace

Json language_pairs_entry(const std::vector<LanguagePair>& pairs) {
  std::vector<double> by_cpu, by_clock;
  for (const auto& [cpp, python] : pairs) {
    const double cpp_cpu_s = fleet_cpu_s(cpp), python_cpu_s = fleet_cpu_s(python);
    if (cpp_cpu_s > 0.0 && python_cpu_s > 0.0) by_cpu.push_back(cpp_cpu_s / python_cpu_s);
    const double cpp_factor = number_in(cpp, "real_time_factor"), python_factor = number_in(python, "real_time_factor");
    if (cpp_factor > 0.0 && python_factor > 0.0) by_clock.push_back(python_factor / cpp_factor);
  }
  const auto figure_or_null = [](const std::vector<double>& values) {
    return values.empty() ? Json() : figure(values);
  };
  return {{"pairs", pairs.size()}, {"speed_cpu", figure_or_null(by_cpu)}, {"speed_clock", figure_or_null(by_clock)}};
}

Json python_rows(const Json& planners, const Json& stepping) {
  Json rows = Json::array();
  for (const auto& [medium, entry] : planners.items()) {
    const std::string name = "speed of hover in Python over that in C++, " + medium;
    if (const Json cpu = value_or(entry, "speed_cpu", Json()); cpu.is_object()) {
      rows.push_back(row_of({"", (name + ", by CPU time").c_str(), 0.7, true, 2}, cpu));
    }
    if (const Json clock = value_or(entry, "speed_clock", Json()); clock.is_object()) {
      rows.push_back(row_of({"", "  by the clock", {}, true, 2}, clock));
    }
  }
  for (const Row& row : kSteppingRows) {
    const Json values = value_or(stepping, row.key, Json::array());
    if (!values.empty()) rows.push_back(row_of(row, figure(values.get<std::vector<double>>())));
  }
  return rows;
}

void print_python(std::ostream& out, const Json& rows) {
  out << fmt::format("\n{:<73}{:>9}{:>9}{:>9}{:>9}\n", "Python, towers, five UAVs, one core", "median", "least", "most",
                     "asked");
  for (const Json& row : rows) {
    const auto cell = [&](const char* name) {
      return fmt::format("{:.{}f}", number_in(row["figure"], name), row["digits"].get<int>());
    };
    const bool asked = row["target"].is_number();
    out << fmt::format("{:<73}{:>9}{:>9}{:>9}{:>9}{}\n", row["name"].get<std::string>(), cell("median"), cell("min"),
                       cell("max"), asked ? fmt::format("{:g}", row["target"].get<double>()) : "-",
                       !asked                   ? ""
                       : row["met"].get<bool>() ? "  met"
                                                : "  missed");
  }
}

int bench_python(const BenchOptions& options, const Console& console) { return PythonBench(options, console).run(); }

}  // namespace skein::cli
