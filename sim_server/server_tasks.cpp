#include "sim_server/server_tasks.hpp"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/scenario/drawn_worlds.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "core/text/number_checks.hpp"
#include "oracle/cache.hpp"
#include "process/files/atomic_file.hpp"
#include "process/files/user_cache.hpp"
#include "process/program.hpp"
#include "scenes/district.hpp"
#include "scenes/scene_export.hpp"
#include "scenes/scene_source.hpp"
#include "scenes/wild/world.hpp"
#include "sim_server/golden/check.hpp"
#include "sim_server/plan/plan_cache.hpp"

namespace skein::sim {

void ServerTasks::add_options(CLI::App& app) {
  app.add_option("--golden", golden, "Compare reference vectors with what the code computes, then stop");
  app.add_option("--export-scene", export_scene, "Write the scene's files to this folder, then stop");
  app.add_option("--scene-picture", scene_picture, "Draw the scene into this folder, then stop");
  app.add_option("--draw-world", draw_world, "With --export-scene: write this drawn world, not the scenario's");
  app.add_flag("--overwrite-export", overwrite_export, "Replace the files of an earlier export");
  app.add_option("--oracle", oracle, "Write the attainable score of the scenario to this file, then stop");
  app.add_option("--clearance", clearances_m, "With --oracle: least distance of the cameras from the structure [m]")
      ->delimiter(',')
      ->check(CLI::Validator(number_within(0.0, 100.0), ""));
  app.add_flag("--vehicle", vehicle, "With --oracle: apply the clearance to the UAVs' bodies, not to their cameras");
  app.add_option("--oracle-patience", oracle_patience_s,
                 "With --oracle: give no answer if its computation takes longer than this [s]");
  app.add_flag("--plan", plan, "With --oracle: also search for what full knowledge scores in the mission's time");
}

int ServerTasks::check_golden() const {
  bool passed = true;
  for (const auto& file : golden) {
    const GoldenReport report = sim::check_golden(file);
    std::cout << fmt::format("{}: {}, {} rows, {} failed, ", file.string(), report.table, report.rows, report.failures)
              << (report.worst > 0.0 ? fmt::format("greatest difference: {:.3g} of the tolerance, in column {}\n",
                                                   report.worst, report.worst_column)
                                     : "no difference\n");
    for (const std::string& message : report.messages) std::cout << "  " << message << '\n';
    passed = passed && report.failures == 0;
  }
  return passed ? kExitDone : kExitCheckFailed;
}

int ServerTasks::write_scene(const ProgramOptions& options) const {
  const World world = [&] {
    const std::uint64_t seed = options.scene_seed.value_or(0);
    if (draw_world == kDistrict) return draw_district(seed, options.uavs.value_or(kUsualDistrictUavs));
    if (!draw_world.empty()) return sim::draw_world(draw_world, seed);
    const Scenario scenario = load_scenario(options.scenario, options.load_options());
    return World{scenario, load_scene(scenario)};
  }();
  const auto write = [&](const std::vector<ExportedFile>& files, const std::filesystem::path& folder) {
    write_export(files, folder, overwrite_export);
    for (const ExportedFile& file : files) std::cout << (folder / file.path).string() << ": " << file.summary << '\n';
  };
  if (!export_scene.empty()) write(scene_export(world.scenario, world.scene), export_scene);
  if (!scene_picture.empty()) write({scene_picture_file(world.scenario, world.scene)}, scene_picture);
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
  const Scene scene = load_scene(scenario, request.cache);
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  const PlanReply planned = sim::ask_plan(
      scenario, scene, {.config = {.threads = request.config.threads}, .search = plan, .cache = request.cache});
  for (const std::string& warning : planned.warnings) spdlog::warn("{}", warning);
  for (const double clearance_m : asked_m) {
    request.config.clearance_m = clearance_m;
    const OracleReply reply = sim::ask_oracle(scenario, scene, request);
    for (const std::string& warning : reply.warnings) spdlog::warn("{}", warning);
    rows.push_back(reply.summary ? to_json(*reply.summary) : nlohmann::ordered_json{{"expected_s", reply.expected_s}});
    if (planned.plan) rows.back()["plan"] = to_json(*planned.plan);
  }
  write_file_atomically(oracle, nlohmann::ordered_json{{"rows", rows}}.dump() + "\n");
  return kExitDone;
}

}  // namespace skein::sim
