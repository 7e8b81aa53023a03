#include "cli/ground_program.hpp"

#include <algorithm>

#include "cli/environment.hpp"
#include "cli/preflight.hpp"
#include "cli/run_result.hpp"

namespace skein::cli {
namespace {

/// Names of strategies that have a program at the ground station; none when uav_agent does not tell, or is missing,
/// which is said where it is needed.
Json listed_ground_programs(const std::filesystem::path& bin_dir) {
  if (!std::filesystem::exists(bin_dir / "uav_agent")) return Json::array();
  const ScratchDir scratch;
  const std::filesystem::path list = scratch.path() / "strategies.json";
  run_to_end({"uav_agent", {bin_dir / "uav_agent", "--list-planners"}, fleet_environment(false), list});
  return value_or(read_json(list), "ground_programs", Json::array());
}

}  // namespace

std::optional<std::string> ground_program(const Planners& planners, const std::filesystem::path& bin_dir) {
  if (planners.ground) return *planners.ground == "none" ? std::nullopt : planners.ground;
  if (exec_command(planners.fallback)) return std::nullopt;
  const std::string name = planners.fallback.substr(0, planners.fallback.find(':'));
  const Json listed = listed_ground_programs(bin_dir);
  const bool has_one = std::find(listed.begin(), listed.end(), Json(name)) != listed.end();
  return has_one ? std::optional(planners.fallback) : std::nullopt;
}

}  // namespace skein::cli
