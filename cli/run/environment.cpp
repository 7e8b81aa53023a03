#include "cli/run/environment.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <string_view>

#include "cli/option_checks.hpp"
#include "core/suggestion.hpp"
#include "core/types.hpp"

namespace skein::cli {
namespace {

/// glibc 2.33 and later name CPU features without the former suffix "_Usable". With these off, libm's selectors fall
/// back to SSE2, which every x86-64 has.
constexpr const char* kBaselineMath = "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX,-SSE4_1";

/// Which settings a program's DDS has is decided by its bus alone. RMW_IMPLEMENTATION is left: it is the library that a
/// ROS 2 node of the user's is built on, and none of ours reads it.
constexpr std::array<std::string_view, 5> kVendorPrefixes = {"CYCLONE", "FASTDDS_", "FASTRTPS_", "RMW_FASTRTPS_",
                                                             "RMW_CYCLONEDDS_"};
constexpr std::array<std::string_view, 8> kVendorNames = {"ROS_DISCOVERY_SERVER",  "ROS_SUPER_CLIENT",
                                                          "ROS_DOMAIN_ID",         "ROS_LOCALHOST_ONLY",
                                                          "ROS_STATIC_PEERS",      "ROS_AUTOMATIC_DISCOVERY_RANGE",
                                                          "SKIP_DEFAULT_XML_FILE", "SKIP_DEFAULT_XML"};
/// Told to each program by its launcher; inherited, they are those of another fleet.
constexpr std::array<std::string_view, 7> kToldNames = {"SKEIN_DDS",      "SKEIN_DOMAIN",   "SKEIN_OUT", "SKEIN_RUN",
                                                        "SKEIN_SCENARIO", "SKEIN_SECURITY", "SKEIN_UAV"};
/// For the user to set. The last three are the test suite's.
const std::vector<std::string> kUserNames = {"SKEIN_AGENT",      "SKEIN_ASSETS",  "SKEIN_BIN_DIR", "SKEIN_CHAOS",
                                             "SKEIN_CONFIG_DIR", "SKEIN_LOG",     "SKEIN_GOLDEN",  "SKEIN_ROS2",
                                             "SKEIN_LONG",       "SKEIN_SANITIZE"};

std::string_view variable_in(std::string_view entry) { return entry.substr(0, entry.find('=')); }

template <class Names>
bool listed(const Names& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_ignored(std::string_view name) {
  return listed(kVendorNames, name) || listed(kToldNames, name) ||
         std::any_of(kVendorPrefixes.begin(), kVendorPrefixes.end(),
                     [&](auto prefix) { return name.starts_with(prefix); });
}

std::map<std::string, std::string> pinned(bool native) {
  // The last one: else Fast DDS takes a file DEFAULT_FASTRTPS_PROFILES.xml that happens to lie in the current folder.
  std::map<std::string, std::string> pins = {{"LC_ALL", "C"}, {"OMP_NUM_THREADS", "1"}, {"SKIP_DEFAULT_XML_FILE", "1"}};
  if (!native) {
    const char* users = std::getenv("GLIBC_TUNABLES");
    pins["GLIBC_TUNABLES"] = (users != nullptr && *users != '\0' ? std::string(users) + ":" : "") + kBaselineMath;
  }
  return pins;
}

}  // namespace

std::vector<std::string> environment_with(const std::map<std::string, std::string>& variables) {
  std::vector<std::string> environment;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text(*entry);
    if (!variables.contains(std::string(variable_in(text)))) environment.emplace_back(text);
  }
  for (const auto& [name, value] : variables) environment.push_back(name + "=" + value);
  return environment;
}

std::vector<std::string> fleet_environment(bool native, const std::map<std::string, std::string>& more) {
  std::map<std::string, std::string> variables = pinned(native);
  for (const auto& [name, value] : more) variables[name] = value;
  std::vector<std::string> environment = environment_with(variables);
  std::erase_if(environment, [&](const std::string& entry) {
    return is_ignored(variable_in(entry)) && !variables.contains(std::string(variable_in(entry)));
  });
  return environment;
}

std::vector<std::string> ignored_variables() {
  std::vector<std::string> names;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    if (is_ignored(variable_in(*entry))) names.emplace_back(variable_in(*entry));
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> environment_warnings() {
  std::vector<std::string> warnings;
  const std::vector<std::string> ignored = ignored_variables();
  if (!ignored.empty()) {
    warnings.push_back("not passed on to the programs, whose DDS is set up by Skein alone: " + joined(ignored));
  }
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string name(variable_in(*entry));
    if (!name.starts_with("SKEIN_") || is_ignored(name) || listed(kUserNames, name)) continue;
    warnings.push_back("nobody reads the variable " + name + "; " + suggestion(name, kUserNames));
  }
  std::sort(warnings.begin(), warnings.end());
  return warnings;
}

void check_environment() {
  const char* chaos = std::getenv("SKEIN_CHAOS");
  if (chaos != nullptr && !check_seed(chaos).empty()) {
    throw InputError(std::string("SKEIN_CHAOS=") + chaos + ": must be a whole number, or not set");
  }
}

std::string fleet_environment_prefix(bool native) {
  std::string prefix;
  for (const std::string& name : ignored_variables()) prefix += (prefix.empty() ? "env -u " : "-u ") + name + " ";
  for (const auto& [name, value] : pinned(native)) prefix += name + "=" + value + " ";
  return prefix;
}

void settle_process() {
  // A descriptor that a shell closed would go to a pipe or a lock, and what we print with it.
  for (int fd = ::open("/dev/null", O_RDWR); fd >= 0; fd = ::open("/dev/null", O_RDWR)) {
    if (fd <= STDERR_FILENO) continue;
    ::close(fd);
    break;
  }
  const mode_t mask = ::umask(0);
  ::umask(mask & (S_IRWXG | S_IRWXO));
  ::signal(SIGCHLD, SIG_DFL);
}

}  // namespace skein::cli
