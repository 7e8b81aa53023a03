#include "process/host/environment.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>

namespace skein {
namespace {

/// Disables CPU features in glibc, so that libm selects its SSE2 code, which every x86-64 CPU can execute. These names
/// of the features are valid for glibc 2.33 and later; older releases append "_Usable" to some of them.
constexpr const char* kBaselineMath = "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX,-SSE4_1";

/// The CPU features for which Debian's NumPy has optional code. Without them it runs its baseline code (SSE to SSE3).
constexpr const char* kBaselineNumpy =
    "SSSE3,SSE41,POPCNT,SSE42,AVX,F16C,FMA3,AVX2,AVX512F,AVX512CD,AVX512_SKX,AVX512_CLX,AVX512_CNL,AVX512_ICL";
/// OpenBLAS's core type for the first 64-bit Intel CPUs: its code uses nothing newer than SSE3.
constexpr const char* kBaselineBlas = "Prescott";

/// Prefixes and names of variables that configure DDS or ROS 2 discovery. The programs do not inherit them, because
/// only Skein itself may configure the DDS of its programs. RMW_IMPLEMENTATION is not among them: it selects the
/// middleware of a user's ROS 2 nodes, and has no effect on the DDS of Skein's own programs.
constexpr std::array<std::string_view, 5> kVendorPrefixes = {"CYCLONE", "FASTDDS_", "FASTRTPS_", "RMW_FASTRTPS_",
                                                             "RMW_CYCLONEDDS_"};
constexpr std::array<std::string_view, 8> kVendorNames = {"ROS_DISCOVERY_SERVER",  "ROS_SUPER_CLIENT",
                                                          "ROS_DOMAIN_ID",         "ROS_LOCALHOST_ONLY",
                                                          "ROS_STATIC_PEERS",      "ROS_AUTOMATIC_DISCOVERY_RANGE",
                                                          "SKIP_DEFAULT_XML_FILE", "SKIP_DEFAULT_XML"};
/// Variables that a launcher sets for each program that it starts. Inherited values would be those of another fleet.
constexpr std::array<std::string_view, 11> kToldNames = {
    "SKEIN_DDS",  "SKEIN_DOMAIN", "SKEIN_EXCHANGE_S", "SKEIN_OUT",      "SKEIN_RADIO_HEARS", "SKEIN_RADIO_SENDS",
    kRunVariable, "SKEIN_ROLE",   "SKEIN_SCENARIO",   "SKEIN_SECURITY", "SKEIN_UAV"};

bool listed(const auto& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

std::string_view variable_in(std::string_view entry) { return entry.substr(0, entry.find('=')); }

bool is_ignored_variable(std::string_view name) {
  return listed(kVendorNames, name) || listed(kToldNames, name) ||
         std::any_of(kVendorPrefixes.begin(), kVendorPrefixes.end(),
                     [&](auto prefix) { return name.starts_with(prefix); });
}

std::map<std::string, std::string> pinned_variables(bool native) {
  // Without SKIP_DEFAULT_XML_FILE, Fast DDS would load DEFAULT_FASTRTPS_PROFILES.xml if the current folder has one.
  std::map<std::string, std::string> pins = {
      {"LC_ALL", "C"},         {"OMP_NUM_THREADS", "1"},       {"OPENBLAS_NUM_THREADS", "1"}, {"MKL_NUM_THREADS", "1"},
      {"PYTHONHASHSEED", "0"}, {"SKIP_DEFAULT_XML_FILE", "1"}, {kPinnedVariable, "1"}};
  if (!native) {
    const char* users = std::getenv("GLIBC_TUNABLES");
    pins["GLIBC_TUNABLES"] = (users != nullptr && *users != '\0' ? std::string(users) + ":" : "") + kBaselineMath;
    pins["NPY_DISABLE_CPU_FEATURES"] = kBaselineNumpy;
    pins["OPENBLAS_CORETYPE"] = kBaselineBlas;
  }
  return pins;
}

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
  std::map<std::string, std::string> variables = pinned_variables(native);
  for (const auto& [name, value] : more) variables[name] = value;
  std::vector<std::string> environment = environment_with(variables);
  std::erase_if(environment, [&](const std::string& entry) {
    return is_ignored_variable(variable_in(entry)) && !variables.contains(std::string(variable_in(entry)));
  });
  return environment;
}

std::vector<std::string> ignored_variables() {
  std::vector<std::string> names;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    if (is_ignored_variable(variable_in(*entry))) names.emplace_back(variable_in(*entry));
  }
  std::sort(names.begin(), names.end());
  return names;
}

void take_fleet_environment(char** argv) {
  if (std::getenv(kPinnedVariable) != nullptr) return;
  // Since kPinnedVariable is not set, no launcher started this program. So SKEIN_RUN, if set, does not come from
  // another fleet's launcher: the user who started this program chose it for this run, and the program keeps it.
  std::map<std::string, std::string> told;
  if (const char* run = std::getenv(kRunVariable)) told[kRunVariable] = run;
  std::vector<std::string> variables = fleet_environment(false, told);
  std::vector<char*> environment;
  for (std::string& variable : variables) environment.push_back(variable.data());
  environment.push_back(nullptr);
  ::execve("/proc/self/exe", argv, environment.data());
  // execve() has failed, for example because there is no /proc. The program goes on in the environment that it was
  // given. If this changes a result, only a comparison of digests shows it.
}

}  // namespace skein
