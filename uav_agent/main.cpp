// uav_agent: one UAV's on-board software with the planner of the user's choice; with `--role gcs`, that strategy's
// program at the ground station.
#include <CLI/CLI.hpp>
#include <iostream>

#include "bus/lockstep/names.hpp"
#include "bus/program_bus.hpp"
#include "core/scenario_reader.hpp"
#include "process/program.hpp"
#include "process/program_report.hpp"
#include "process/reports.hpp"
#include "process/run_folder.hpp"
#include "uav_agent/agent_node.hpp"
#include "uav_agent/ground_node.hpp"

namespace {

struct AgentOptions {
  std::string role = "uav";
  std::string uav, planner = "patrol";
  bool list = false;
};

/// For the launcher and for people: which strategies there are, and which have a program at the ground station.
int list_strategies() {
  const skein::StrategyList list{skein::agent::planner_names(), skein::agent::ground_program_names()};
  std::cout << skein::json_of(list).dump() << std::endl;
  return skein::kExitDone;
}

int fly(skein::agent::MemberNode& node, const std::string& member, const skein::ProgramOptions& options,
        skein::StopSignal& stop) {
  stop.on_stop([&node] { node.inbox().wake(); });
  const int code = skein::bus::exit_code(skein::bus::run_node(node, &stop), node.member());
  stop.on_stop({});
  const skein::agent::CpuHistogram& cpu = node.planner_cpu();
  const skein::AgentReport report{.planner_cpu_s = cpu.total_s(),
                                  .planner_cpu_p99_ms = 1e3 * cpu.quantile_s(0.99),
                                  .planner_cpu_max_ms = 1e3 * cpu.max_s(),
                                  .planner_exchanges_over_50ms = cpu.over_field_exchange(),
                                  .malformed = node.malformed(),
                                  .unsent = node.unsent()};
  const std::filesystem::path file =
      options.out / skein::run_folder::report_file(skein::programs::agent_program(member));
  skein::StatusPipe status(options.status_fd);
  skein::hand_in_report(skein::json_of(report), file, status);
  return code;
}

int run_uav(const skein::Scenario& scenario, const skein::ProgramOptions& options, const AgentOptions& agent,
            skein::StopSignal& stop) {
  const std::string uav = agent.uav.empty() ? scenario.fleet.front().name : agent.uav;
  const skein::UavIndex index = scenario.uav_index(uav);
  auto planner = skein::agent::make_planner(agent.planner, skein::agent::agent_config(scenario, index));
  const auto bus = skein::bus::make_bus(options);
  if (options.check_only) return skein::kExitDone;
  skein::agent::AgentNode node(scenario, index, std::move(planner), options.domain, *bus);
  return fly(node, uav, options, stop);
}

int run_ground(const skein::Scenario& scenario, const skein::ProgramOptions& options, const AgentOptions& agent,
               skein::StopSignal& stop) {
  auto program = skein::agent::make_ground_program(agent.planner, skein::agent::ground_config(scenario));
  const auto bus = skein::bus::make_bus(options);
  if (options.check_only) return skein::kExitDone;
  skein::agent::GroundNode node(scenario, std::move(program), options.domain, *bus);
  return fly(node, std::string(skein::bus::kGcsName), options, stop);
}

}  // namespace

int main(int argc, char** argv) {
  AgentOptions agent;
  const auto add_options = [&](CLI::App& app) {
    app.add_option("--role", agent.role, "uav, or gcs: the strategy's program at the ground station")
        ->check(CLI::IsMember({"uav", "gcs"}))
        ->capture_default_str();
    app.add_option("--uav", agent.uav, "UAV whose software this is (default: the first of the fleet)");
    app.add_option("--planner", agent.planner, "NAME or NAME:key=value,... or NAME:file.yaml");
    app.add_flag("--list-planners", agent.list, "Print the strategies' names as JSON, then stop");
  };
  return skein::run_program(skein::programs::kAgent, argc, argv, add_options,
                            [&](const skein::ProgramOptions& options, skein::StopSignal& stop) {
                              if (agent.list) return list_strategies();
                              auto load = options.load_options();
                              load.needs_scene_files = false;
                              const skein::Scenario scenario = skein::load_scenario(options.scenario, load);
                              return agent.role == "gcs" ? run_ground(scenario, options, agent, stop)
                                                         : run_uav(scenario, options, agent, stop);
                            });
}
