// comm_router: relays radio messages between the domains of the nodes, as far as there is line of sight.
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <optional>
#include <system_error>

#include "bus/program_bus.hpp"
#include "comm_router/router_node.hpp"
#include "process/program.hpp"
#include "process/program_report.hpp"
#include "process/reports.hpp"
#include "process/run_folder.hpp"

namespace {

/// What a router knows beside its counts.
struct Notes {
  std::uint64_t malformed = 0, unheard = 0, unsent = 0;
  std::vector<std::string> warnings = {};
  std::vector<std::string> unwritten = {};  ///< files that the disk refused
};

skein::RadioCounts radio_counts(const skein::router::LinkCounts& counts) {
  return {.sent = counts.sent,
          .delivered = counts.delivered,
          .dropped_no_los = counts.dropped_no_los,
          .dropped_fault = counts.dropped_fault,
          .dropped_overflow = counts.dropped_overflow,
          .duplicated = counts.duplicated,
          .sent_bytes = counts.sent_bytes,
          .delivered_bytes = counts.delivered_bytes};
}

void write_report(const std::filesystem::path& folder, const skein::Scenario& scenario,
                  const skein::router::LinkGate& gate, const Notes& notes, skein::StatusPipe& status) {
  skein::RouterReport report{.total = radio_counts(gate.total()),
                             .malformed = notes.malformed,
                             .unheard = notes.unheard,
                             .unsent = notes.unsent,
                             .warnings = notes.warnings,
                             .unwritten = notes.unwritten};
  for (const skein::Node from : gate.nodes()) {
    for (const skein::Node to : gate.nodes()) {
      const skein::router::LinkCounts& counts = gate.counts().at(from, to);
      if (counts.sent == 0) continue;
      report.per_link.push_back(
          {.from = scenario.node_name(from), .to = scenario.node_name(to), .counts = radio_counts(counts)});
    }
  }
  const std::filesystem::path file = folder / skein::run_folder::report_file(skein::programs::kCommRouter);
  skein::hand_in_report(skein::json_of(report), file, status);
}

/// A router that died for good has left its counts: makes its report of them.
int settle(const std::filesystem::path& folder, const std::filesystem::path& counts, const skein::Scenario& scenario,
           skein::RunId run, skein::StatusPipe& status) {
  const std::vector<skein::RadioRoute> no_routes;
  const std::size_t nodes = scenario.fleet.size() + 1;
  skein::router::LinkGate gate(no_routes, nodes);
  gate.restore(skein::router::CountStore(counts, nodes, run).earlier_counts());
  write_report(folder, scenario, gate, {}, status);
  std::filesystem::remove(counts);
  return skein::kExitDone;
}

/// A router without counts on disk routes as well as any; it only forgets them when it is killed.
std::optional<skein::router::CountStore> open_counts(const std::filesystem::path& file, std::size_t nodes,
                                                     skein::RunId run, std::vector<std::string>& unwritten) try {
  return std::optional<skein::router::CountStore>(std::in_place, file, nodes, run);
} catch (const std::system_error& error) {
  spdlog::warn("{}; a router that is killed will not remember what it counted", error.what());
  unwritten.push_back(error.what());
  return std::nullopt;
}

int run(const skein::ProgramOptions& options, bool settle_only, skein::StopSignal& stop) {
  auto load = options.load_options();
  load.needs_scene_files = false;
  const skein::Scenario scenario = skein::load_scenario(options.scenario, load);
  const skein::FaultPlan faults = skein::load_fault_plan(options.faults, scenario, options.seed);
  const std::filesystem::path counts = options.out / skein::run_folder::kCounts;
  skein::StatusPipe status(options.status_fd);
  if (settle_only) return settle(options.out, counts, scenario, options.run, status);
  const auto bus = skein::bus::make_bus(options);
  if (options.check_only) return skein::kExitDone;
  std::optional<int> code;
  while (!code) {  // once more after a fault that stopped us: what waited in the router is lost, as after its death
    std::vector<std::string> unwritten;
    std::optional<skein::router::CountStore> store =
        open_counts(counts, scenario.fleet.size() + 1, options.run, unwritten);
    skein::router::RouterNode node(scenario, options.seed, options.domain, *bus, faults, options.out);
    if (store) node.keep_counts(*store);
    stop.on_stop([&node] { node.inbox().wake(); });
    const skein::bus::NodeEnd end = skein::bus::run_node(node, &stop);
    stop.on_stop({});
    if (end != skein::bus::NodeEnd::resumed) code = skein::bus::exit_code(end, skein::programs::kCommRouter);
    unwritten.insert(unwritten.end(), node.unwritten().begin(), node.unwritten().end());
    const Notes notes{node.malformed(), node.unheard(), node.unsent(), node.stranger_warnings(), unwritten};
    if (code) write_report(options.out, scenario, node.gate(), notes, status);
  }
  std::filesystem::remove(counts);
  return *code;
}

}  // namespace

int main(int argc, char** argv) {
  bool settle_only = false;
  const auto add_options = [&](CLI::App& app) {
    app.add_flag("--settle", settle_only, "Write the report of a router that died in this folder, then stop")
        ->group("Launcher");
  };
  return skein::run_program(skein::programs::kCommRouter, argc, argv, add_options,
                            [&](const auto& options, auto& stop) { return run(options, settle_only, stop); });
}
