#include "cli/place/placement.hpp"

#include <algorithm>
#include <cstdlib>
#include <set>

#include "cli/sweep/engines.hpp"
#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "host/preflight.hpp"
#include "host/supervisor.hpp"
#include "process/host/environment.hpp"
#include "process/host/host_name.hpp"
#include "results/run_folder.hpp"

namespace skein::cli {
namespace {

using Words = std::vector<std::string>;

constexpr const char* kSlurm = "slurm";

std::string skein_there(const PlaceOptions& place) {
  return place.skein ? place.skein->string() : launcher_file().string();
}

Words ssh_words(const PlaceOptions& place, const std::string& host) {
  Words words = shell_words(place.ssh);
  if (words.empty()) throw InputError("--ssh: must be a command");
  if (words.front().find('/') == std::string::npos) words.insert(words.begin(), "/usr/bin/env");
  // No keep-alive by ssh: the launcher detects a silent host sooner (kSilence).
  words.insert(words.end(), {"-T", "-o", "BatchMode=yes", "-o", "ConnectTimeout=10", "--", host,
                             "exec " + shell_word(skein_there(place)) + " --host"});
  return words;
}

Words srun_words(const PlaceOptions& place, const std::string& node) {
  return {"/usr/bin/env",       "srun",    "--overlap",        "--nodes=1", "--ntasks=1",
          "--nodelist=" + node, "--quiet", skein_there(place), "--host"};
}

/// The nodes of the Slurm allocation in which this process runs, without its own. @throws InputError for none.
Words other_nodes() {
  const char* list = ::getenv("SLURM_JOB_NODELIST");
  if (list == nullptr || *list == '\0') {
    throw InputError(
        "--place slurm: this is not an allocation of Slurm (salloc, sbatch); name hosts instead: UAV=HOST,...");
  }
  const ScratchDir scratch;
  const std::filesystem::path log = scratch.path() / "nodes";
  const ExitStatus exit =
      run_to_end({"scontrol", {"/usr/bin/env", "scontrol", "show", "hostnames", list}, environment_with({}), log});
  constexpr std::size_t kMostNodes = 10000;
  Words nodes = last_lines(log, kMostNodes);
  if (!exit.ok())
    throw InputError("--place slurm: scontrol show hostnames " + std::string(list) + ": " + joined(nodes));
  const char* own = ::getenv("SLURMD_NODENAME");
  std::erase(nodes, own != nullptr ? own : host_name());
  if (nodes.empty()) throw InputError("--place slurm: the allocation has one node, and this is it; leave --place out");
  return nodes;
}

/// Members and their hosts. With Slurm, the UAVs take the nodes of the allocation in turn.
std::vector<std::pair<std::string, std::string>> pairs_of(const FleetPlan& plan) {
  std::vector<std::pair<std::string, std::string>> pairs;
  if (*plan.options.place.at == kSlurm) {
    const Words nodes = other_nodes();
    for (const UavConfig& uav : plan.scenario.fleet) pairs.emplace_back(uav.name, nodes[pairs.size() % nodes.size()]);
    return pairs;
  }
  for (const std::string& entry : split(*plan.options.place.at)) {
    const std::size_t equals = entry.find('=');
    const std::string member = entry.substr(0, equals),
                      host = equals == std::string::npos ? "" : entry.substr(equals + 1);
    if (member.empty() || host.empty()) throw InputError("--place " + entry + ": must be UAV=HOST,...");
    if (host.front() == '-' || host.find('/') != std::string::npos)
      throw InputError("--place " + entry + ": " + host + " is not a host");
    pairs.emplace_back(member, host);
  }
  return pairs;
}

void check_member(const FleetPlan& plan, const std::string& member) {
  if (std::ranges::find(programs::kServers, member) != programs::kServers.end()) {
    throw InputError("--place " + member + ": stays with the launcher, as do all that know the scene; place UAVs" +
                     (plan.ground ? ", or gcs" : ""));
  }
  Words known;
  for (const UavConfig& uav : plan.scenario.fleet) known.push_back(uav.name);
  if (plan.ground) known.emplace_back("gcs");
  if (std::ranges::find(known, member) != known.end()) return;
  if (member == "gcs") throw InputError("--place gcs: no program runs at the ground station of this fleet");
  throw InputError("--place: there is no UAV '" + member + "'; " + suggestion(member, known));
}

}  // namespace

std::vector<PlacedHost> read_placement(const FleetPlan& plan) {
  const PlaceOptions& place = plan.options.place;
  std::vector<PlacedHost> hosts;
  if (!place.at) return hosts;
  if (!plan.options.debug.empty()) {
    throw InputError("--debug and --place: a program that stands in a debugger needs this host; leave out one of them");
  }
  std::set<std::string> placed;
  for (const auto& [member, name] : pairs_of(plan)) {
    check_member(plan, member);
    if (!placed.insert(member).second) throw InputError("--place: " + member + " is placed twice");
    auto host = std::ranges::find(hosts, name, &PlacedHost::name);
    if (host == hosts.end()) {
      hosts.push_back({name, {}, *place.at == kSlurm ? srun_words(place, name) : ssh_words(place, name)});
      host = hosts.end() - 1;
    }
    host->programs.push_back(programs::program_of(member));
  }
  return hosts;
}

}  // namespace skein::cli
