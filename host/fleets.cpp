#include "host/fleets.hpp"

#include <unistd.h>

#include <algorithm>
#include <system_error>

#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "core/text/whole_number.hpp"
#include "core/types.hpp"
#include "host/proc_table.hpp"
#include "host/supervisor.hpp"
#include "process/host/host_lock.hpp"
#include "results/run_folder.hpp"

namespace skein::cli {
namespace {

using Words = std::vector<std::string>;

std::string value_after(const Words& words, const std::string& option) {
  const auto found = std::find(words.begin(), words.end(), option);
  return found == words.end() || found + 1 == words.end() ? "" : *(found + 1);
}

std::string variable(const Words& environment, const std::string& name) {
  const auto found =
      std::ranges::find_if(environment, [&](const auto& entry) { return entry.starts_with(name + "="); });
  return found == environment.end() ? "" : found->substr(name.size() + 1);
}

double number_or(const std::string& text, double otherwise) { return parse_number(text).value_or(otherwise); }

/// Name of the fleet's program that has this command line; empty: no program has it. The command line of a debugger
/// contains that of the program, but not at its beginning, so the debugger is not taken for the program.
std::string program_in(const Words& words) {
  if (words.size() < 2 || words[1] != "--scenario" || value_after(words, "--out").empty()) return {};
  const std::string uav = value_after(words, "--uav");
  if (!uav.empty()) return programs::agent_program(uav);
  if (value_after(words, "--role") == "gcs") return programs::kGroundAgent;
  const std::string name = std::filesystem::path(words[0]).filename();
  return std::ranges::find(programs::kServers, name) == programs::kServers.end() ? "" : name;
}

bool has_variables(pid_t pid, const std::string& uav, const std::string& out) {
  const Words environment = words_of(pid, "environ");
  return variable(environment, "SKEIN_UAV") == uav && variable(environment, "SKEIN_OUT") == out;
}

void read_server(pid_t pid, const Words& words, RunningFleet& fleet) {
  fleet.scenario = value_after(words, "--scenario");
  fleet.base_domain = parse_whole<int>(value_after(words, "--domain")).value_or(0);
  fleet.agent_timeout_s = number_or(value_after(words, "--agent-timeout"), fleet.agent_timeout_s);
  fleet.lease_s = number_or(value_after(words, "--lease"), fleet.lease_s);
  if (const auto uavs = parse_whole<std::size_t>(value_after(words, "--uavs"))) fleet.uavs = *uavs;
  fleet.network = value_after(words, "--network");
  fleet.elsewhere = !shares_network(pid);
  if (!fleet.elsewhere) fleet.launcher = HostLock::holder(domain_lock_name(fleet.base_domain));
}

}  // namespace

std::vector<RunningFleet> running_fleets(uid_t user) {
  std::map<std::string, RunningFleet> fleets;
  for (const pid_t pid : all_processes()) {
    if (!belongs_to(pid, user)) continue;
    const Words words = words_of(pid, "cmdline");
    if (const std::string program = program_in(words); !program.empty()) {
      RunningFleet& fleet = fleets[value_after(words, "--out")];
      fleet.programs[program] = pid;
      if (const std::string keys = value_after(words, "--security"); !keys.empty()) fleet.keys[program] = keys;
      if (program == programs::kSimServer) read_server(pid, words, fleet);
      continue;
    }
    // A user's command (exec:) has these variables, and its children inherit them: the command is the process whose
    // parent does not have them.
    const Words environment = words_of(pid, "environ");
    const std::string uav = variable(environment, "SKEIN_UAV"), out = variable(environment, "SKEIN_OUT");
    if (uav.empty() || out.empty() || has_variables(parent_of(pid), uav, out)) continue;
    fleets[out].programs[programs::agent_program(uav)] = pid;
  }
  std::vector<RunningFleet> all;
  for (auto& [dir, fleet] : fleets) {
    fleet.dir = dir;
    if (fleet.programs.contains(programs::kSimServer)) all.push_back(std::move(fleet));
  }
  return all;
}

RunningFleet chosen_fleet(const std::optional<std::filesystem::path>& dir, const std::string& command,
                          const std::string& option) {
  std::vector<RunningFleet> fleets = running_fleets(::geteuid());
  if (dir) {
    std::erase_if(fleets, [&](const RunningFleet& fleet) {
      std::error_code gone;
      return !std::filesystem::equivalent(fleet.dir, *dir, gone);
    });
    if (fleets.empty()) {
      throw InputError(option + " " + dir->string() + ": no fleet writes there; `skein ps` lists the fleets that fly");
    }
  }
  if (fleets.empty()) throw InputError(command + ": no fleet of yours is flying");
  // Choose a fleet of another network namespace only if none flies in this one.
  const auto elsewhere = [](const RunningFleet& fleet) { return fleet.elsewhere; };
  if (!std::ranges::all_of(fleets, elsewhere)) std::erase_if(fleets, elsewhere);
  std::vector<std::string> names;
  for (const RunningFleet& fleet : fleets) names.push_back(shown_folder(fleet.dir));
  if (fleets.size() > 1) throw InputError(command + ": say which fleet, " + option + " " + joined(names, " or "));
  return fleets.front();
}

std::string shown_folder(const std::filesystem::path& dir) {
  const std::filesystem::path nearby = std::filesystem::proximate(dir);
  return nearby.string().starts_with("..") ? dir : nearby;
}

std::optional<double> simulated_s(const RunningFleet& fleet) {
  const std::vector<std::string> lines =
      last_lines(fleet.dir / run_folder::kTrajectories, 2);  // the last line may be incomplete
  return lines.size() < 2 ? std::nullopt : parse_number(lines[0].substr(0, lines[0].find(',')));
}

std::string state_text(pid_t pid) {
  const pid_t tracer = tracer_of(pid);
  if (tracer != 0) return "debugged by " + process_name(tracer) + " (process " + std::to_string(tracer) + ")";
  return has_stopped(pid) ? "stopped" : "runs";
}

}  // namespace skein::cli
