#include "cli/place/place_commands.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "core/text/text.hpp"
#include "process/host/host_name.hpp"
#include "process/program.hpp"
#include "results/run_folder.hpp"
#include "run/exec_variables.hpp"
#include "run/fleet_programs.hpp"
#include "run/results_dir.hpp"

namespace skein::cli {
namespace {

constexpr int kLease_s = 10;  ///< without a launcher, only leases tell which program died
constexpr int kServerTimeout_s = 60;

/// The value of --network: the user's; else the domain of each placed program has its host and this one as peers.
std::string network_text(const FleetPlan& plan, const std::vector<PlacedHost>& hosts, const std::string& own) {
  if (plan.options.network) return *plan.options.network;
  std::string text;
  for (const PlacedHost& host : hosts) {
    const std::string name = host.name.substr(host.name.find('@') + 1);
    for (const std::string& program : host.programs) {
      text += fmt::format("{}'{}': {{peers: ['{}', '{}']}}", text.empty() ? "" : ", ", programs::member_name(program),
                          own, name);
    }
  }
  return "{" + text + "}";
}

class Script {
 public:
  Script(const FleetPlan& plan, std::string network) : plan_(plan), network_(std::move(network)), run_(draw_run_id()) {}

  std::string command(const std::string& program, const std::string& out) const {
    const int base = plan_.options.domain.value_or(kFirstDomain);
    if (is_exec(plan_, program)) {
      const std::string domain = std::to_string(agent_domain(plan_, program, base));
      std::string part;
      for (const auto& [name, value] : part_variables(plan_, program)) part += name + "=" + shell_word(value) + " ";
      return part + fmt::format(
                        "SKEIN_DOMAIN={0} ROS_DOMAIN_ID={0} SKEIN_UAV={1} SKEIN_RUN={2} SKEIN_DDS={3} "
                        "SKEIN_NETWORK={4} SKEIN_OUT={5} /bin/sh -c {6} &\n",
                        domain, shell_word(programs::member_name(program)), run_, dds_vendors(plan_).at(program),
                        shell_word(network_), shell_word(out),
                        shell_word(*exec_command(planner_of(plan_, program).spec)));
    }
    std::vector<std::string> words = {program_file(plan_, program)};
    const std::vector<std::string> own = program_arguments(plan_, program, base);
    words.insert(words.end(), own.begin(), own.end());
    words.insert(words.end(), {"--network", network_, "--run", std::to_string(run_), "--lease",
                               std::to_string(plan_.options.lease_s.value_or(kLease_s)), "--server-timeout",
                               std::to_string(kServerTimeout_s), "--keep", "--out", out});
    return shell_line(words) + " &\n";
  }

 private:
  const FleetPlan& plan_;
  const std::string network_;
  const std::uint64_t run_;
};

}  // namespace

std::string place_commands(const FleetPlan& plan, const std::vector<PlacedHost>& hosts) {
  const std::string own = host_name("localhost");
  const std::string out = std::filesystem::absolute(
      plan.options.out.value_or(default_results_dir(plan.scenario.name, plan.options.planner, plan.options.seed)));
  const Script script(plan, network_text(plan, hosts, own));
  std::vector<std::string> here(programs::kServers.begin(), programs::kServers.end());
  for (const UavConfig& uav : plan.scenario.fleet) here.push_back(programs::agent_program(uav.name));
  if (plan.ground) here.emplace_back(programs::kGroundAgent);
  for (const PlacedHost& host : hosts) {
    std::erase_if(here, [&](const auto& one) { return std::ranges::find(host.programs, one) != host.programs.end(); });
  }
  std::string text = fmt::format("# on this host, {}\nmkdir -p {}\n", own, shell_word(out));
  for (const std::string& program : here) text += script.command(program, out);
  std::string copies;
  for (const PlacedHost& host : hosts) {
    text += fmt::format(
        "wait\n\n# on {}: with the same Skein, scenario and planner files in the same places\nmkdir -p {}\n", host.name,
        shell_word(out));
    for (const std::string& program : host.programs) text += script.command(program, out);
    copies += fmt::format("scp -r {}:{}/. {}\n", host.name, shell_word(out), shell_word(out));
  }
  return text + "wait\n\n# when the run is over, on this host\n" + copies + "skein merge " + shell_word(out) + "\n";
}

}  // namespace skein::cli
