#include "run/program_files.hpp"

#include <algorithm>

#include "core/planners/python_spec.hpp"
#include "results/run_folder.hpp"
#include "run/python_planners.hpp"

namespace skein::cli {

namespace fs = std::filesystem;

fs::path parameter_file(const UavPlanner& planner) {
  if (const auto python = python_spec(planner.spec)) {
    return python->parameters.find('=') == std::string::npos ? fs::path(python->parameters) : fs::path();
  }
  const std::size_t colon = planner.spec.find(':');
  if (exec_command(planner.spec) || colon == std::string::npos || planner.spec.find('=') != std::string::npos) {
    return {};
  }
  return planner.spec.substr(colon + 1);
}

std::vector<fs::path> scenario_files(const FleetPlan& plan, const std::string& program) {
  std::vector<fs::path> files = plan.scenario.vehicle_files;
  files.push_back(plan.scenario.file);
  files.push_back(plan.faults.file);
  files.push_back(plan.faults.named);
  if (program == programs::kSimServer) {  // the only one that knows the scene
    const SceneConfig& scene = plan.scenario.scene;
    files.insert(files.end(), scene.meshes.begin(), scene.meshes.end());
    files.push_back(scene.points);
    files.push_back(scene.boxes);
  }
  std::erase_if(files, [](const fs::path& file) { return file.empty(); });
  return files;
}

std::vector<fs::path> planner_files(const FleetPlan& plan, const std::string& program) {
  std::vector<fs::path> files;
  if (!programs::is_agent(program)) return files;
  const UavPlanner& planner = planner_of(plan, program);
  if (const fs::path parameters = parameter_file(planner); !parameters.empty()) files.push_back(parameters);
  if (const auto python = python_spec(planner.spec)) {
    const std::vector<fs::path> sources = python_sources(python->file);
    files.insert(files.end(), sources.begin(), sources.end());
  }
  return files;
}

}  // namespace skein::cli
