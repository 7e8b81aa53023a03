// uav_agent: one UAV's on-board software with the planner of the user's choice.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "bus/program_bus.hpp"
#include "core/atomic_file.hpp"
#include "core/program.hpp"
#include "core/scenario_reader.hpp"
#include "uav_agent/agent_node.hpp"

int main(int argc, char** argv) {
  std::string uav, planner_spec = "patrol";
  const auto add_options = [&](CLI::App& app) {
    app.add_option("--uav", uav, "UAV whose software this is (default: the first of the fleet)");
    app.add_option("--planner", planner_spec, "NAME or NAME:key=value,... or NAME:file.yaml");
  };
  return skein::run_program(
      "uav_agent", argc, argv, add_options, [&](const skein::ProgramOptions& options, skein::StopSignal& stop) {
        auto load = options.load_options();
        load.needs_scene_files = false;
        const skein::Scenario scenario = skein::load_scenario(options.scenario, load);
        if (uav.empty()) uav = scenario.fleet.front().name;
        const std::size_t index = scenario.uav_index(uav);
        auto planner = skein::agent::make_planner(planner_spec, skein::agent::agent_config(scenario, index));
        const auto bus = skein::bus::make_bus(options);
        if (options.check_only) return skein::kExitDone;
        skein::agent::AgentNode node(scenario, index, std::move(planner), options.domain, *bus);
        stop.on_stop([&node] { node.wake(); });
        const int code = node.run(stop);
        stop.on_stop({});
        const nlohmann::json report = {{"planner_cpu_s", node.planner_cpu_s()},
                                       {"malformed", node.malformed()}};
        skein::write_file_atomically(options.out / ("uav_agent-" + uav + ".report.json"), report.dump(2) + "\n");
        return code;
      });
}
