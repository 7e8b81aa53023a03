// sim_server: physics, sensors, links, referee and the lock-step clock of one run.
#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>
#include <thread>

#include "bus/program_bus.hpp"
#include "core/scenario_reader.hpp"
#include "process/atomic_file.hpp"
#include "process/program.hpp"
#include "process/run_folder.hpp"
#include "process/status_lines.hpp"
#include "sim_server/golden/check.hpp"
#include "sim_server/oracle/cache.hpp"
#include "sim_server/scenes/scene_export.hpp"
#include "sim_server/scenes/scene_source.hpp"
#include "sim_server/scenes/scene_warnings.hpp"
#include "sim_server/sim_node.hpp"

namespace {

struct ServerOptions {
  std::string clock = "lockstep";
  std::optional<double> stop_at_s;
  double agent_timeout_s = 60.0;
  std::vector<std::filesystem::path> golden;
  std::filesystem::path export_scene;  ///< folder; empty: none
  bool overwrite_export = false;
  bool ground_program = false;
  std::filesystem::path oracle;      ///< file for its answer; empty: it is not asked
  std::vector<double> clearances_m;  ///< empty: the usual one
  bool vehicle = false;              ///< it is the UAVs' bodies that keep them
  std::optional<double> oracle_patience_s;
};

std::optional<double> realtime_factor(const std::string& clock) {
  if (clock == "lockstep") return std::nullopt;
  const std::string realtime = "realtime";
  if (clock == realtime) return 1.0;
  if (clock.starts_with(realtime + ":")) {
    char* end = nullptr;
    const std::string text = clock.substr(realtime.size() + 1);
    const double factor = std::strtod(text.c_str(), &end);
    if (!text.empty() && *end == '\0' && factor > 0.0 && factor <= 1000.0) return factor;
  }
  throw skein::InputError("--clock " + clock +
                          ": it must be lockstep, realtime or realtime:FACTOR with a factor above 0");
}

// Each member adds participants whose discovery the others pay for: on two cores a hundred UAVs take half a minute.
double startup_timeout_s(const ServerOptions& server, const skein::Scenario& scenario) {
  constexpr double kPerUav_s = 2.0, kLeast_s = 20.0;  // however quick the members' answers must be
  if (server.agent_timeout_s <= 0.0) return 0.0;      // for ever
  return std::max(server.agent_timeout_s, kLeast_s) + kPerUav_s * static_cast<double>(scenario.fleet.size());
}

int check_golden(const std::vector<std::filesystem::path>& files) {
  bool passed = true;
  for (const auto& file : files) {
    const skein::sim::GoldenReport report = skein::sim::check_golden(file);
    std::cout << fmt::format("{}: {}, {} rows, {} failed, worst difference {:.3g} of its tolerance ({})\n",
                             file.string(), report.table, report.rows, report.failures, report.worst,
                             report.worst_column);
    for (const std::string& message : report.messages) std::cout << "  " << message << '\n';
    passed = passed && report.failures == 0;
  }
  return passed ? skein::kExitDone : skein::kExitCheckFailed;
}

int export_scene(const skein::Scenario& scenario, const ServerOptions& server) {
  const auto files = skein::sim::scene_export(scenario, skein::sim::load_scene(scenario));
  skein::sim::write_export(files, server.export_scene, server.overwrite_export);
  for (const skein::sim::ExportedFile& file : files) {
    std::cout << (server.export_scene / file.path).string() << ": " << file.summary << '\n';
  }
  return skein::kExitDone;
}

int ask_oracle(const skein::Scenario& scenario, const ServerOptions& server) {
  skein::sim::OracleRequest request;
  request.config.berth = server.vehicle ? skein::sim::Berth::body : skein::sim::Berth::camera;
  request.config.threads = std::max(1U, std::thread::hardware_concurrency());
  request.patience_s = server.oracle_patience_s;
  request.cache = skein::sim::user_cache_folder();
  std::vector<double> clearances_m = server.clearances_m;
  if (clearances_m.empty()) clearances_m = {server.vehicle ? 0.0 : request.config.clearance_m};
  const skein::Scene scene = skein::sim::load_scene(scenario);
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const double clearance_m : clearances_m) {
    request.config.clearance_m = clearance_m;
    const skein::sim::OracleReply reply = skein::sim::ask_oracle(scenario, scene, request);
    for (const std::string& warning : reply.warnings) spdlog::warn("{}", warning);
    rows.push_back(reply.summary ? to_json(*reply.summary) : nlohmann::ordered_json{{"expected_s", reply.expected_s}});
  }
  skein::write_file_atomically(server.oracle, nlohmann::ordered_json{{"rows", rows}}.dump() + "\n");
  return skein::kExitDone;
}

// Orders of the launcher; they arrive on the pipe's own thread.
void obey(skein::sim::SimNode& node, const std::string& line) {
  const std::optional<skein::orders::Line> order = skein::orders::read_line(line);
  if (!order) {
    spdlog::warn("unknown order: {}", line);
  } else if (const auto* lost = std::get_if<skein::orders::Lost>(&*order)) {
    node.report_lost(lost->member);
  } else {
    node.request_stop();
  }
}

int run(const skein::ProgramOptions& options, const ServerOptions& server, skein::StopSignal& stop) {
  if (!server.golden.empty()) return check_golden(server.golden);
  const skein::Scenario scenario = skein::load_scenario(options.scenario, options.load_options());
  if (!server.export_scene.empty()) return export_scene(scenario, server);
  if (!server.oracle.empty()) return ask_oracle(scenario, server);
  skein::sim::SimNodeOptions node_options{.base_domain = options.domain,
                                          .out = options.out,
                                          .seed = options.seed,
                                          .realtime_factor = realtime_factor(server.clock),
                                          .stop_at_s = server.stop_at_s,
                                          .agent_timeout_s = server.agent_timeout_s,
                                          .startup_timeout_s = startup_timeout_s(server, scenario),
                                          .expect_gcs_program = server.ground_program,
                                          .faults = skein::load_fault_plan(options.faults, scenario, options.seed)};
  skein::Scene scene = skein::sim::load_scene(scenario);
  const auto bus = skein::bus::make_bus(options);
  if (options.check_only) {
    for (const std::string& warning : skein::sim::scene_warnings(scene)) spdlog::warn("{}", warning);
    skein::sim::Simulation(scenario, std::move(scene), options.seed);  // starts must be free
    return skein::kExitDone;
  }
  skein::StatusPipe status(options.status_fd);
  skein::sim::SimNode node(scenario, std::move(scene), node_options, *bus, status);
  const skein::ControlPipe control(options.control_fd, [&](const std::string& line) { obey(node, line); });
  stop.on_stop([&] { node.abort(); });
  const skein::sim::RunSummary summary = node.run();
  stop.on_stop({});
  return summary.status == skein::RunStatus::aborted ? skein::kExitInterrupted : skein::kExitDone;
}

}  // namespace

int main(int argc, char** argv) {
  ServerOptions server;
  const auto add_options = [&](CLI::App& app) {
    app.add_option("--clock", server.clock, "lockstep, realtime or realtime:FACTOR");
    app.add_option("--stop-at", server.stop_at_s, "end at this simulated time [s]")->check(CLI::PositiveNumber);
    app.add_option("--agent-timeout", server.agent_timeout_s, "wall time to wait for a member [s], 0: for ever")
        ->check(CLI::NonNegativeNumber);
    app.add_flag("--ground-program", server.ground_program,
                 "wait for a program at the ground station before the start");
    app.add_option("--golden", server.golden, "run reference vectors through the production code, then stop");
    app.add_option("--export-scene", server.export_scene, "write the scene's files to this folder, then stop");
    app.add_flag("--overwrite-export", server.overwrite_export, "replace the files of an earlier export");
    app.add_option("--oracle", server.oracle, "write what is attainable in the scenario to this file, then stop");
    app.add_option("--clearance", server.clearances_m, "with --oracle: of the cameras from the structure [m]")
        ->delimiter(',')
        ->check(CLI::Range(0.0, 100.0));
    app.add_flag("--vehicle", server.vehicle, "with --oracle: the UAVs' bodies keep the clearance, not their cameras");
    app.add_option("--oracle-patience", server.oracle_patience_s,
                   "with --oracle: no answer that takes longer to compute [s]");
  };
  return skein::run_program(skein::programs::kSimServer, argc, argv, add_options,
                            [&](const auto& options, auto& stop) { return run(options, server, stop); });
}
