#include "sim_server/server_tasks.hpp"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>

#include "process/atomic_file.hpp"
#include "process/program.hpp"
#include "sim_server/golden/check.hpp"
#include "sim_server/oracle/cache.hpp"
#include "sim_server/scenes/scene_export.hpp"
#include "sim_server/scenes/scene_source.hpp"

namespace skein::sim {

void ServerTasks::add_options(CLI::App& app) {
  app.add_option("--golden", golden, "run reference vectors through the production code, then stop");
  app.add_option("--export-scene", export_scene, "write the scene's files to this folder, then stop");
  app.add_flag("--overwrite-export", overwrite_export, "replace the files of an earlier export");
  app.add_option("--oracle", oracle, "write what is attainable in the scenario to this file, then stop");
  app.add_option("--clearance", clearances_m, "with --oracle: of the cameras from the structure [m]")
      ->delimiter(',')
      ->check(CLI::Range(0.0, 100.0));
  app.add_flag("--vehicle", vehicle, "with --oracle: the UAVs' bodies keep the clearance, not their cameras");
  app.add_option("--oracle-patience", oracle_patience_s, "with --oracle: no answer that takes longer to compute [s]");
}

int ServerTasks::check_golden() const {
  bool passed = true;
  for (const auto& file : golden) {
    const GoldenReport report = sim::check_golden(file);
    std::cout << fmt::format("{}: {}, {} rows, {} failed, worst difference {:.3g} of its tolerance ({})\n",
                             file.string(), report.table, report.rows, report.failures, report.worst,
                             report.worst_column);
    for (const std::string& message : report.messages) std::cout << "  " << message << '\n';
    passed = passed && report.failures == 0;
  }
  return passed ? kExitDone : kExitCheckFailed;
}

int ServerTasks::write_scene(const Scenario& scenario) const {
  const auto files = scene_export(scenario, load_scene(scenario));
  write_export(files, export_scene, overwrite_export);
  for (const ExportedFile& file : files) {
    std::cout << (export_scene / file.path).string() << ": " << file.summary << '\n';
  }
  return kExitDone;
}

int ServerTasks::ask_oracle(const Scenario& scenario) const {
  OracleRequest request;
  request.config.berth = vehicle ? Berth::body : Berth::camera;
  request.config.threads = std::max(1U, std::thread::hardware_concurrency());
  request.patience_s = oracle_patience_s;
  request.cache = user_cache_folder();
  std::vector<double> asked_m = clearances_m;
  if (asked_m.empty()) asked_m = {vehicle ? 0.0 : request.config.clearance_m};
  const Scene scene = load_scene(scenario);
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const double clearance_m : asked_m) {
    request.config.clearance_m = clearance_m;
    const OracleReply reply = sim::ask_oracle(scenario, scene, request);
    for (const std::string& warning : reply.warnings) spdlog::warn("{}", warning);
    rows.push_back(reply.summary ? to_json(*reply.summary) : nlohmann::ordered_json{{"expected_s", reply.expected_s}});
  }
  write_file_atomically(oracle, nlohmann::ordered_json{{"rows", rows}}.dump() + "\n");
  return kExitDone;
}

}  // namespace skein::sim
