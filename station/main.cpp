// station: the ground station, which tallies what reaches it.
#include <CLI/CLI.hpp>
#include <optional>

#include "bus/program_bus.hpp"
#include "core/scenario_reader.hpp"
#include "process/program.hpp"
#include "process/run_folder.hpp"
#include "station/settlement.hpp"
#include "station/station_node.hpp"

namespace {

int run(const skein::ProgramOptions& options, bool settle_only, skein::StopSignal& stop) {
  auto load = options.load_options();
  load.needs_scene_files = false;
  const skein::Scenario scenario = skein::load_scenario(options.scenario, load);
  if (settle_only) {
    skein::StatusPipe status(options.status_fd);
    skein::station::settle(options.out, scenario, options.run, status);
    return skein::kExitDone;
  }
  const auto bus = skein::bus::make_bus(options);
  if (options.check_only) return skein::kExitDone;
  skein::StatusPipe status(options.status_fd);
  std::optional<int> code;
  while (!code) {  // once more after a fault that stopped us: the journal is our memory
    skein::station::StationNode node(scenario, options.domain, *bus, options.out, status);
    stop.on_stop([&node] { node.wake(); });
    code = node.run(stop);
    stop.on_stop({});
  }
  return *code;
}

}  // namespace

int main(int argc, char** argv) {
  bool settle_only = false;
  const auto add_options = [&](CLI::App& app) {
    app.add_flag("--settle", settle_only, "Write the report of a station that died in this folder, then stop")
        ->group("Launcher");
  };
  return skein::run_program(skein::programs::kStation, argc, argv, add_options,
                            [&](const auto& options, auto& stop) { return run(options, settle_only, stop); });
}
