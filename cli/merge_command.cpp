#include "cli/merge_command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <ostream>

#include "cli/compose/agents_folder.hpp"
#include "cli/run_results.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "core/text/text.hpp"
#include "host/preflight.hpp"
#include "process/files/atomic_file.hpp"
#include "process/host/environment.hpp"
#include "process/program.hpp"
#include "recording/mcap/reader.hpp"
#include "results/reported_facts.hpp"
#include "results/result_file.hpp"
#include "results/run_folder.hpp"
#include "results/run_record.hpp"
#include "run/fleet_plan.hpp"
#include "run/recording.hpp"
#include "run/results_dir.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

/// The options of the flight, from the server's report; defaults where the report says nothing.
RunOptions options_of(const FlightReport& flight, const MergeOptions& options,
                      const std::optional<std::string>& rules) {
  RunOptions run;
  run.scenario = options.scenario.value_or(flight.scenario.value_or(run.scenario));
  run.assets = options.assets;
  run.seed = flight.seed.value_or(0);
  if (flight.scene_seed.value_or(0) > 0) run.scene_seed = *flight.scene_seed;
  if (flight.uavs.value_or(0) > 0) run.uavs = *flight.uavs;
  run.duration_s = flight.duration_s;
  run.rules = rules;
  run.report = options.report;
  run.clock = flight.clock.value_or(run.clock);
  return run;
}

Scenario scenario_of(const RunOptions& run) {
  LoadOptions load = load_options(run);
  load.needs_scene_files = false;
  try {
    return load_scenario(run.scenario, load);
  } catch (const InputError& error) {
    throw InputError(std::string(error.what()) +
                     "\n(the server's report names this scenario; --scenario FILE names another)");
  }
}

/// The defect of a program's report: for example, it is truncated, or lacks a key that every report of this program
/// has. nullopt if the report is sound.
std::optional<std::string> damage_in(const Json& json, const std::string& program) {
  if (!json.is_object()) return "is damaged: it is not a JSON object";
  if (!has_sound_checksum(json)) {
    return "is damaged, or was edited: its checksum does not match its contents (Skein accepts it unchecked if you "
           "delete the key 'checksum')";
  }
  if (program == programs::kSimServer && !struct_of<SimServerReport>(json).status) {
    return "is damaged: 'status' is missing, or has no valid value";
  }
  if (program == programs::kStation && !struct_of<StationReport>(json).score) {
    return "is damaged: 'score' is missing, or is not a number of at least 0";
  }
  return std::nullopt;
}

bool has_report(const fs::path& dir, const std::string& program) {
  std::error_code error;
  return fs::exists(fs::symlink_status(dir / run_folder::report_file(program), error));
}

/// The defect of the report file of a program; nullopt if the report is sound, or there is none.
std::optional<std::string> damage_of(const fs::path& dir, const std::string& program) {
  if (!has_report(dir, program)) return std::nullopt;
  return damage_in(read_json(dir / run_folder::report_file(program)), program);
}

/// Refuses a damaged report: a result made without it would be wrong, and would not show it.
/// @throws InputError if the report is damaged
void require_sound(const fs::path& dir, const std::string& program) {
  const std::optional<std::string> damage = damage_of(dir, program);
  if (!damage) return;
  throw InputError((dir / run_folder::report_file(program)).string() + ": " + *damage +
                   ", and nothing else is there to make it from; copy the file again, "
                   "or delete it to get a result without what " +
                   program + " reported");
}

/// If a program died before it wrote its report, or the report is damaged, starts it again to write the report from its
/// journal (the file `books`). @throws InputError if the report is damaged and cannot be restored from a journal
void settle(const char* program, const char* books, const RunOptions& run, const FlightReport& flight,
            const fs::path& dir, std::ostream& err) {
  const fs::path report = dir / run_folder::report_file(program);
  const std::optional<std::string> damage = damage_of(dir, program);
  if (!damage && fs::exists(report)) return;
  if (!fs::exists(dir / books)) return require_sound(dir, program);
  if (damage) err << report.string() << ": " << *damage << "; Skein restores it from " << books << std::endl;
  std::vector<std::string> argv = {program_dir() / program,
                                   "--settle",
                                   "--scenario",
                                   run.scenario,
                                   "--out",
                                   dir,
                                   "--run",
                                   std::to_string(flight.run.value_or(0))};
  if (run.uavs) argv.insert(argv.end(), {"--uavs", std::to_string(*run.uavs)});
  if (run.rules) argv.insert(argv.end(), {"--rules", *run.rules});
  const std::string log = run_folder::log_file(program);
  const ExitStatus exit = run_to_end({program, argv, fleet_environment(false), dir / log, true});
  if (damage_of(dir, program)) {
    throw InputError(report.string() + ": is damaged, and Skein cannot restore it from " + books + ": see " + log);
  }
  if (exit.ok() || fs::exists(report)) return;
  err << report.string() << ": is missing, and Skein cannot restore it from " << books << " (" << exit.text()
      << "): see " << log << std::endl;
}

/// The values in a launcher's result.json that no report has. Null if there is no result, or if it is damaged.
Json launchers_facts(const fs::path& dir, std::ostream& err) try {
  std::error_code error;
  if (!fs::exists(dir / run_folder::kResult, error)) return {};
  const Json result = results::read_result_file(dir);
  Json facts;
  for (const char* key : {"command", "startup_s", "memory_mb", "processes"}) {
    if (result.contains(key)) facts[key] = result[key];
  }
  return facts;
} catch (const InputError& damage) {
  err << damage.what() << "; Skein makes it again" << std::endl;
  return {};
}

/// The text of result.json, with these facts.
std::string with_facts(const std::string& text, const Json& facts) {
  if (facts.is_null()) return text;
  Json result = Json::parse(text);
  result.update(facts);
  return results::result_text(std::move(result));
}

results::RunFacts facts_of(const RunOptions& run, const Scenario& scenario, const results::Reports& reports,
                           const fs::path& dir) {
  results::RunFacts facts = results::reported_facts(dir, scenario, reports);
  facts.scenario = run.scenario;
  facts.seed = run.seed;
  facts.clock = run.clock;
  return facts;
}

/// Why there is no result. @param damage  the defect of the server's report; nullopt: there is no report
std::string no_server(const MergeOptions& options, const std::optional<std::string>& damage) {
  if (damage) return (options.dir / run_folder::report_file(programs::kSimServer)).string() + ": " + *damage;
  return options.dir.string() + ": there is no " + run_folder::report_file(programs::kSimServer) +
         " in it: the run is not over, or its server died";
}

/// Prevents a launcher, or another merge, from using the folder at the same time: joining the parts of a recording
/// deletes them, even while a fleet still writes to them. @throws InputError if the folder is in use or missing
FolderLock lock_of(const fs::path& dir) try {
  std::error_code error;
  if (!fs::is_directory(dir, error)) throw InputError(dir.string() + ": there is no such folder");
  return FolderLock(dir);
} catch (const FolderInUse&) {
  throw InputError(dir.string() + ": a launcher is writing there now; it makes the result itself when the run ends");
}

/// A run whose server left no report has no result, but the parts that its programs recorded can still be joined.
/// @param why  as no_server() says it. @throws InputError when there is no part.
int merge_without_server(const MergeOptions& options, const fs::path& dir, const std::string& why,
                         const Console& console) {
  const std::vector<fs::path> parts = recording_parts(dir);
  if (parts.empty()) throw InputError(why);
  gather_agents(dir);
  const std::string trouble = join_parts(dir, Json::object());
  if (trouble.empty()) {
    std::uint64_t end_ns = 0;
    mcap::Reader(dir / run_folder::kRecording).messages([&](const mcap::Channel&, const mcap::Message& message) {
      end_ns = std::max(end_ns, message.log_time);
    });
    console.out << (options.dir / run_folder::kRecording).string() << ": up to "
                << fixed(1e-9 * static_cast<double>(end_ns), 2) << " s, joined from";
    for (const fs::path& part : parts) console.out << ' ' << part.filename().string();
    console.out << std::endl;
  } else {
    console.err << trouble << std::endl;
  }
  for (const char* program : programs::kServers) {
    const bool recorded = std::ranges::any_of(
        parts, [&](const fs::path& part) { return part.filename().string().starts_with(std::string(program) + "."); });
    if (!recorded) console.err << "missing: what " << program << " recorded" << std::endl;
  }
  console.err << "missing: " << run_folder::kResult << "; " << why << std::endl;
  return kExitProcessFailed;
}

}  // namespace

void add_merge(CLI::App& app, MergeOptions& merge) {
  CLI::App* command =
      app.add_subcommand("merge", "Make result.json from the reports of programs that ran without the launcher");
  command->add_option("DIR", merge.dir, "Folder with the reports")->required();
  command->add_option("--scenario", merge.scenario,
                      "Scenario that was flown, if the name in the server's report is unknown on this host");
  command->add_option("--assets", merge.assets,
                      "Folder of data files (with models/) for scenarios that need them, such as mbs");
  command->add_flag("--no-report{false}", merge.report, "Do not write report.html");
  command->footer("Example:\n  skein merge results");
}

int merge_reports(const MergeOptions& options, const Console& console) {
  const fs::path dir = fs::absolute(options.dir);
  const FolderLock lock = lock_of(options.dir);
  const bool reported = has_report(dir, programs::kSimServer);
  const Json server = read_json(dir / run_folder::report_file(programs::kSimServer));
  if (const auto damage = damage_in(server, programs::kSimServer)) {
    return merge_without_server(options, dir, no_server(options, reported ? damage : std::nullopt), console);
  }
  const Json facts_of_launcher = launchers_facts(dir, console.err);
  gather_agents(dir);
  const auto sim = struct_of<SimServerReport>(server);
  const RunOptions run = options_of(sim.flight, options, sim.rules);
  const Scenario scenario = scenario_of(run);
  for (const UavConfig& uav : scenario.fleet) require_sound(dir, programs::agent_program(uav.name));
  require_sound(dir, programs::kGroundAgent);
  settle(programs::kStation, run_folder::kJournal, run, sim.flight, dir, console.err);
  settle(programs::kCommRouter, run_folder::kCounts, run, sim.flight, dir, console.err);
  const results::Reports reports = results::read_reports(dir, scenario, {{programs::kSimServer, server}});
  const results::RunFacts facts = facts_of(run, scenario, reports, dir);
  const RunResults results{run, facts, scenario, reports, dir, [&](const std::string& text) {
                             return write_if_possible(dir / run_folder::kResult, with_facts(text, facts_of_launcher));
                           }};
  // Damage of the recording does not affect the result, but it must not go unnoticed.
  const std::vector<std::string> damage = recording_damage(dir);
  const auto result = write_results(
      results, options.dir, [&] { return fs::exists(dir / run_folder::kRecording) ? damage : Texts(); }, console);
  for (const std::string& one : damage) console.err << one << std::endl;
  if (!result) return kExitProcessFailed;
  const Texts tables = results::damaged_files(dir);  // the page reads around them
  for (const std::string& one : tables) console.err << options.dir.string() << ": " << one << std::endl;
  if (results::anyone_lost(*result)) return kExitProcessFailed;
  return damage.empty() && tables.empty() ? kExitDone : kExitCheckFailed;
}

}  // namespace skein::cli
