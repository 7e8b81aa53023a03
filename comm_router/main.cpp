// comm_router: relays radio messages between the domains of the nodes, as far as there is line of sight.
#include <nlohmann/json.hpp>

#include "bus/program_bus.hpp"
#include "comm_router/router_node.hpp"
#include "core/atomic_file.hpp"
#include "core/program.hpp"

namespace {

void write_report(const std::filesystem::path& folder, const skein::Scenario& scenario,
                  const skein::router::RouterNode& node) {
  const skein::router::LinkGate& gate = node.gate();
  const auto counts_json = [](const skein::router::LinkCounts& counts) {
    return nlohmann::json{{"sent", counts.sent},
                          {"delivered", counts.delivered},
                          {"dropped_no_los", counts.dropped_no_los},
                          {"dropped_fault", counts.dropped_fault},
                          {"dropped_overflow", counts.dropped_overflow},
                          {"duplicated", counts.duplicated}};
  };
  nlohmann::json json = counts_json(gate.total());
  json["malformed"] = node.malformed();
  json["per_link"] = nlohmann::json::array();
  for (skein::Node from = 0; from < gate.nodes(); ++from) {
    for (skein::Node to = 0; to < gate.nodes(); ++to) {
      if (gate.counts(from, to).sent == 0) continue;
      nlohmann::json link = counts_json(gate.counts(from, to));
      link["from"] = scenario.node_name(from);
      link["to"] = scenario.node_name(to);
      json["per_link"].push_back(std::move(link));
    }
  }
  skein::write_file_atomically(folder / "comm_router.report.json", json.dump(2) + "\n");
}

int run(const skein::ProgramOptions& options, skein::StopSignal& stop) {
  auto load = options.load_options();
  load.needs_scene_files = false;
  const skein::Scenario scenario = skein::load_scenario(options.scenario, load);
  const skein::FaultPlan faults = skein::load_fault_plan(options.faults, scenario);
  const auto bus = skein::bus::make_bus(options);
  if (options.check_only) return skein::kExitDone;
  skein::router::RouterNode node(scenario, options.seed, options.domain, *bus, faults);
  stop.on_stop([&node] { node.wake(); });
  const int code = node.run(stop);
  stop.on_stop({});
  write_report(options.out, scenario, node);
  return code;
}

}  // namespace

int main(int argc, char** argv) { return skein::run_program("comm_router", argc, argv, {}, run); }
