// station: the ground station, which tallies what reaches it.
#include "bus/program_bus.hpp"
#include "core/program.hpp"
#include "core/scenario_reader.hpp"
#include "station/station_node.hpp"

namespace {

int run(const skein::ProgramOptions& options, skein::StopSignal& stop) {
  auto load = options.load_options();
  load.needs_scene_files = false;
  const skein::Scenario scenario = skein::load_scenario(options.scenario, load);
  const auto bus = skein::bus::make_bus(options);
  if (options.check_only) return skein::kExitDone;
  skein::StatusPipe status(options.status_fd);
  skein::station::StationNode node(scenario, options.domain, *bus, options.out, status);
  stop.on_stop([&node] { node.wake(); });
  const int code = node.run(stop);
  stop.on_stop({});
  return code;
}

}  // namespace

int main(int argc, char** argv) { return skein::run_program("station", argc, argv, {}, run); }
