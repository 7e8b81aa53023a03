#include "cli/ros_command.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <vector>

#include "core/suggestion.hpp"
#include "core/text.hpp"
#include "core/types.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStepLibrary = "lib/libskein_step.so";
constexpr const char* kFastDdsProfile = "share/skein_ros/fastdds_udp.xml";

std::vector<fs::path> prefixes(const std::string& spec) {
  const char* const path = std::getenv("AMENT_PREFIX_PATH");
  if (path == nullptr || *path == '\0') {
    throw InputError("--planner " + spec +
                     ": no ROS 2 here: AMENT_PREFIX_PATH is not set; source the setup file of a " +
                     "workspace with skein_ros (docs/ros2.md)");
  }
  std::vector<fs::path> result;
  for (const std::string& prefix : split(path, ':')) result.emplace_back(prefix);
  return result;
}

std::vector<std::string> executables_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const auto permissions = entry.status().permissions();
    if (entry.is_regular_file() && (permissions & fs::perms::owner_exec) != fs::perms::none) {
      names.push_back(entry.path().filename());
    }
  }
  return names;
}

fs::path find_executable(const std::string& spec, const std::string& package, const std::string& name) {
  std::set<std::string> packages;
  for (const fs::path& prefix : prefixes(spec)) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(prefix / "share/ament_index/resource_index/packages", error)) {
      packages.insert(entry.path().filename());
    }
    const fs::path folder = prefix / "lib" / package;
    const std::vector<std::string> names = executables_in(folder);
    if (std::find(names.begin(), names.end(), name) != names.end()) return folder / name;
    if (!names.empty()) {
      throw InputError("--planner " + spec + ": the package " + package + " has no executable '" + name + "'; " +
                       suggestion(name, names));
    }
  }
  if (packages.contains(package)) {
    throw InputError("--planner " + spec + ": the package " + package + " has no executables");
  }
  throw InputError("--planner " + spec + ": AMENT_PREFIX_PATH has no package '" + package + "'; " +
                   suggestion(package, {packages.begin(), packages.end()}));
}

/// Where the package skein_ros is.
fs::path find_skein_ros(const std::string& spec) {
  for (const fs::path& prefix : prefixes(spec)) {
    if (fs::exists(prefix / kStepLibrary)) return prefix;
  }
  throw InputError("--planner " + spec + ": AMENT_PREFIX_PATH has no package skein_ros, which takes a node into the " +
                   "lock-step; build it beside your packages (docs/ros2.md)");
}

}  // namespace

std::optional<std::string> ros_command(const std::string& spec) {
  if (!spec.starts_with(kRos)) return std::nullopt;
  const std::string rest = spec.substr(kRos.size());
  const std::size_t space = std::min(rest.find(' '), rest.size());
  const std::string node = rest.substr(0, space), arguments = rest.substr(space);
  const std::size_t slash = node.find('/');
  if (slash == std::string::npos || slash == 0 || slash + 1 == node.size()) {
    throw InputError("--planner " + spec + ": write ros:PACKAGE/EXECUTABLE, such as ros:my_package/my_node");
  }
  const fs::path executable = find_executable(spec, node.substr(0, slash), node.substr(slash + 1));
  const fs::path skein_ros = find_skein_ros(spec);
  return "ROS_LOG_DIR=\"$SKEIN_OUT/ros-$SKEIN_UAV\" "
         "FASTRTPS_DEFAULT_PROFILES_FILE=${FASTRTPS_DEFAULT_PROFILES_FILE:-" +
         shell_word(skein_ros / kFastDdsProfile) + "} LD_PRELOAD=" + shell_word(skein_ros / kStepLibrary) +
         "${LD_PRELOAD:+\" $LD_PRELOAD\"} exec " + shell_word(executable) + arguments +
         " --ros-args -r __ns:=/\"$SKEIN_UAV\"";
}

}  // namespace skein::cli
