#include "run/inputs_outlast.hpp"

#include <algorithm>
#include <system_error>

#include "core/planners/hand_spec.hpp"
#include "core/types.hpp"
#include "results/run_folder.hpp"
#include "run/program_files.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kHandFile = "file=";  ///< the parameter of the planner `hand` that names its commands

bool is_same(const fs::path& one, const fs::path& other) {
  std::error_code error;
  return fs::equivalent(one, other, error) && !error;
}

/// Whether a run in `dir` deletes what is at this absolute path.
bool is_deleted(const fs::path& file, const fs::path& dir) {
  if (run_folder::is_of_a_run(file.filename()) && is_same(file.parent_path(), dir)) return true;
  for (fs::path folder = file.parent_path(); folder.has_relative_path(); folder = folder.parent_path()) {
    if (folder.filename() == run_folder::kPlannerFiles && is_same(folder.parent_path(), dir)) return true;
  }
  return false;
}

void add_planner(const UavPlanner& planner, std::vector<fs::path>& files) {
  for (const std::string& parameter : hand_parameters(planner.spec).value_or(std::vector<std::string>{})) {
    if (parameter.starts_with(kHandFile)) files.emplace_back(parameter.substr(kHandFile.size()));
  }
}

}  // namespace

std::vector<fs::path> input_files(const FleetPlan& plan) {
  std::vector<fs::path> files = scenario_files(plan, programs::kSimServer);
  const auto add_all = [&](const std::vector<fs::path>& more) { files.insert(files.end(), more.begin(), more.end()); };
  for (const UavPlanner& planner : plan.planners) {
    add_all(planner_files(plan, programs::agent_program(planner.uav)));
    add_planner(planner, files);
  }
  if (plan.ground) add_all(planner_files(plan, programs::kGroundAgent));
  add_all(agent_files(plan));
  const RunOptions& options = plan.options;
  if (options.faults) files.push_back(*options.faults);
  if (options.network) files.emplace_back(*options.network);
  if (options.place.at) files.emplace_back(*options.place.at);
  if (options.replay) files.push_back(options.replay->recording);
  return files;
}

void check_outlast(const std::vector<fs::path>& files, const fs::path& dir) {
  for (const fs::path& file : files) {
    std::error_code error;
    if (!fs::exists(file, error))
      continue;  // a name like "all" of --network, or a missing file, which another check reports
    const fs::path named = fs::absolute(file), target = fs::canonical(file, error);
    // Without lexically_normal(): "..", after a link, leads elsewhere than the text says.
    if (!is_deleted(named, dir) && (error || !is_deleted(target, dir))) continue;
    throw InputError(file.string() + ": this run reads the file, but also writes its results to " + dir.string() +
                     ", where it first deletes files of this name; choose another --out");
  }
}

void check_inputs_outlast(const FleetPlan& plan, const fs::path& dir) { check_outlast(input_files(plan), dir); }

}  // namespace skein::cli
