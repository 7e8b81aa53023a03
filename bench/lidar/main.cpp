// bench_lidar: measures the CPU time of a LiDAR scan along flown paths. Takes the poses of a run's trajectories.csv
// (ten per simulated second, as many as a LiDAR has scans) and runs the production LiDAR at each of them, whether or
// not the run's own planner read that scan. Prints one line of JSON on stdout.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "process/host/thread_cpu.hpp"
#include "process/program.hpp"
#include "results/run_folder.hpp"
#include "results/run_tables.hpp"
#include "scenes/scene_source.hpp"
#include "sim_server/sensors/lidar.hpp"

namespace {

using skein::Isometry3d;
using skein::Scenario;
using skein::Tick;

/// Poses X_WB of the fleet at one instant, by fleet index. A UAV that is missing (truncated line) is not moved.
using Poses = std::map<std::size_t, Isometry3d>;

/// @returns X_WB by tick and fleet index. Columns: time_s, uav, x, y, z, qw, qx, qy, qz, ...
std::map<Tick, Poses> read_trajectories(const std::string& file, const Scenario& scenario) {
  std::ifstream in(file);
  std::string line;
  if (!std::getline(in, line) || !line.starts_with(skein::run_tables::kPoseColumns)) {
    throw skein::InputError(file + ": is not a " + skein::run_folder::kTrajectories + " of a run");
  }
  std::map<Tick, Poses> poses;
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    std::string time_s, uav;
    std::getline(cells, time_s, ',');
    std::getline(cells, uav, ',');
    double value[7];
    for (double& number : value) {
      cells >> number;
      cells.ignore(1);
    }
    if (!cells) continue;
    Isometry3d X_WB = Isometry3d::Identity();
    X_WB.translation() << value[0], value[1], value[2];
    X_WB.linear() = Eigen::Quaterniond(value[3], value[4], value[5], value[6]).normalized().toRotationMatrix();
    poses[std::llround(std::stod(time_s) * skein::kTicksPerSecond)][scenario.uav_index(uav)] = X_WB;
  }
  return poses;
}

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0.0;
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

nlohmann::json measure(const Scenario& scenario, const std::map<Tick, Poses>& path) {
  const skein::Scene scene = skein::sim::load_scene(scenario);
  std::vector<skein::sim::BodyShape> bodies;
  std::vector<std::pair<std::size_t, skein::sim::Lidar>> lidars;
  for (const skein::UavIndex i : scenario.uavs()) {
    const skein::VehicleConfig& vehicle = scenario.fleet[i].vehicle;
    bodies.push_back(skein::sim::body_shape(vehicle));
    if (vehicle.lidar) lidars.emplace_back(i, skein::sim::Lidar(*vehicle.lidar, i, 0));
  }
  skein::sim::RayScene rays(scene.mesh, bodies);
  std::vector<double> scan_ms;
  std::size_t returns = 0;
  for (const auto& [tick, poses] : path) {
    for (const auto& [uav, X_WB] : poses) rays.set_pose(skein::UavIndex(uav), X_WB);
    for (auto& [uav, lidar] : lidars) {
      const auto pose = poses.find(uav);
      if (pose == poses.end() || !lidar.due(tick)) continue;
      const double before_s = skein::thread_cpu_s();
      returns += lidar.scan(tick, pose->second, rays).points_W.size();
      scan_ms.push_back(1e3 * (skein::thread_cpu_s() - before_s));
    }
  }
  double total_ms = 0.0;
  for (const double ms : scan_ms) total_ms += ms;
  const double scans = std::max<double>(1.0, static_cast<double>(scan_ms.size()));
  return {{"scans", scan_ms.size()},
          {"mean_ms", total_ms / scans},
          {"median_ms", quantile(scan_ms, 0.5)},
          {"p95_ms", quantile(scan_ms, 0.95)},
          {"mean_returns", static_cast<double>(returns) / scans},
          {"triangles", scene.mesh.triangles.size()}};
}

}  // namespace

int main(int argc, char** argv) {
  std::string trajectories;
  const auto add_options = [&](CLI::App& app) {
    app.add_option("--trajectories", trajectories, "trajectories.csv of a run of this scenario")->required();
  };
  return skein::run_program("bench_lidar", argc, argv, add_options,
                            [&](const skein::ProgramOptions& options, skein::StopSignal&) {
                              const Scenario scenario = skein::load_scenario(options.scenario, options.load_options());
                              std::cout << measure(scenario, read_trajectories(trajectories, scenario)) << std::endl;
                              return skein::kExitDone;
                            });
}
