#include "run/ros_command.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <vector>

#include "core/planners/uav_planner.hpp"
#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "core/types.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStepLibrary = "lib/libskein_step.so";
constexpr const char* kFastDdsProfile = "share/skein_ros/fastdds_udp.xml";
constexpr const char* kFastDdsLoopback = "share/skein_ros/fastdds_loopback.xml";
constexpr const char* kCycloneDdsLoopback =
    "<General><Interfaces><NetworkInterface name=\"lo\" multicast=\"false\"/></Interfaces>"
    "<AllowMulticast>false</AllowMulticast></General>"
    "<Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>31</MaxAutoParticipantIndex>"
    "<Peers><Peer address=\"127.0.0.1\"/></Peers></Discovery>";

/// The install prefixes of AMENT_PREFIX_PATH, of which the first that has a package counts.
std::vector<fs::path> prefixes() {
  const char* const path = std::getenv("AMENT_PREFIX_PATH");
  std::vector<fs::path> result;
  for (const std::string& prefix : split(path == nullptr ? "" : path, ':')) {
    if (!prefix.empty()) result.emplace_back(prefix);
  }
  return result;
}

void require_ros(const std::string& spec) {
  if (!prefixes().empty()) return;
  throw InputError("--planner " + spec + ": no ROS 2 here: AMENT_PREFIX_PATH is not set; source the setup file of a " +
                   "workspace with skein_ros (docs/how-to-ros2.md)");
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
  for (const fs::path& prefix : prefixes()) {
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

/// Install prefix of the package skein_ros. @throws InputError when AMENT_PREFIX_PATH has none
fs::path find_skein_ros(const std::string& spec) {
  if (const auto prefix = skein_ros_prefix()) return *prefix;
  throw InputError("--planner " + spec + ": AMENT_PREFIX_PATH has no package skein_ros, which takes a node into the " +
                   "lock-step; build it beside your packages (docs/how-to-ros2.md)");
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
  require_ros(spec);
  const fs::path executable = find_executable(spec, node.substr(0, slash), node.substr(slash + 1));
  const fs::path skein_ros = find_skein_ros(spec);
  return "if [ -n \"${SKEIN_SECURITY-}\" ]; then " + enclave_command("\"$SKEIN_SECURITY\"") +
         "; if [ -z \"${SKEIN_NETWORK-}\" ]; then " + loopback_command(skein_ros) +
         "; fi; fi; "
         "ROS_LOG_DIR=\"$SKEIN_OUT/ros-$SKEIN_UAV\" "
         "FASTRTPS_DEFAULT_PROFILES_FILE=${FASTRTPS_DEFAULT_PROFILES_FILE:-" +
         shell_word(skein_ros / kFastDdsProfile) + "} LD_PRELOAD=" + shell_word(skein_ros / kStepLibrary) +
         "${LD_PRELOAD:+\" $LD_PRELOAD\"} exec " + shell_word(executable) + arguments +
         " --ros-args -r __ns:=/\"$SKEIN_UAV\"";
}

std::string enclave_command(const std::string& keys) {
  return "ln -sfn . " + keys + "/enclaves && export ROS_SECURITY_ENABLE=true ROS_SECURITY_STRATEGY=Enforce " +
         "ROS_SECURITY_KEYSTORE=" + keys + " ROS_SECURITY_ENCLAVE_OVERRIDE=/";
}

std::string loopback_command(const std::filesystem::path& prefix) {
  return "export CYCLONEDDS_URI=" + shell_word(kCycloneDdsLoopback) +
         " FASTRTPS_DEFAULT_PROFILES_FILE=" + shell_word(prefix / kFastDdsLoopback);
}

void check_secure_middleware(const std::string& dds) {
  const char* const variable = std::getenv("RMW_IMPLEMENTATION");
  const std::string chosen = variable == nullptr ? "" : variable;
  const std::string wanted = dds == "fastdds" ? "rmw_fastrtps_cpp" : "rmw_cyclonedds_cpp";
  if (chosen.substr(0, chosen.find('_', 4)) == wanted.substr(0, wanted.find('_', 4))) return;
  throw InputError("--secure --dds " + dds +
                   ": the vendors' security does not work together reliably, so ROS 2 nodes " +
                   "need RMW_IMPLEMENTATION=" + wanted + " (it is " + (chosen.empty() ? "not set" : chosen) +
                   "), or the fleet another --dds");
}

std::optional<std::filesystem::path> skein_ros_prefix() {
  const std::vector<fs::path> all = prefixes();
  const auto found =
      std::ranges::find_if(all, [](const fs::path& prefix) { return fs::exists(prefix / kStepLibrary); });
  return found == all.end() ? std::nullopt : std::optional(*found);
}

std::filesystem::path fastdds_profile(const std::filesystem::path& prefix) { return prefix / kFastDdsProfile; }

}  // namespace skein::cli
