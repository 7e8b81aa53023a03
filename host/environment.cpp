#include "host/environment.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>

#include "core/text/suggestion.hpp"
#include "core/text/whole_number.hpp"
#include "core/types.hpp"
#include "host/threads.hpp"

namespace skein::cli {
namespace {

/// The variables SKEIN_... that cause no warning: those that users set, those of docker/compose.yaml, of the build and
/// of the tests, and those that Skein's programs set for each other (for example SKEIN_SWEEP_MERGES,
/// cli/sweep/slurm.hpp, and SKEIN_OTHER_CLOCK_S, process/host/other_clock.hpp).
const std::vector<std::string> kKnownNames = {
    "SKEIN_AGENT",         "SKEIN_ASSETS",        "SKEIN_BIN_DIR",      "SKEIN_CHAOS",       "SKEIN_CONFIG_DIR",
    "SKEIN_DURATION",      "SKEIN_LOG",           "SKEIN_NETWORK",      kThreadsVariable,    "SKEIN_WEB",
    "SKEIN_DEBUG_VALUES",  "SKEIN_HASH_SEED",     "SKEIN_IMAGE",        "SKEIN_AGENT_IMAGE", "SKEIN_PYTHON_AGENT_IMAGE",
    "SKEIN_USER",          "SKEIN_UID",           "SKEIN_GID",          "SKEIN_WITHOUT_WEB", "SKEIN_GOLDEN",
    "SKEIN_ROS2",          "SKEIN_LONG",          "SKEIN_SANITIZE",     "SKEIN_TURN",        "SKEIN_TURNS",
    "SKEIN_FUZZ_SEED",     "SKEIN_WRITE_DIGESTS", "SKEIN_LAUNCHER",     "SKEIN_LOADER",      "SKEIN_SWEEP_MERGES",
    "SKEIN_OTHER_CLOCK_S", "SKEIN_RUN",           "SKEIN_STEP_ENTERED", kPinnedVariable};

}  // namespace

std::vector<std::string> environment_warnings() {
  std::vector<std::string> warnings;
  const std::vector<std::string> ignored = ignored_variables();
  if (!ignored.empty()) {
    warnings.push_back(
        "not passed on to the programs of a fleet, because Skein itself configures their DDS and "
        "tells each program its role: " +
        joined(ignored));
  }
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string name(variable_in(*entry));
    if (!name.starts_with("SKEIN_") || is_ignored_variable(name) ||
        std::ranges::find(kKnownNames, name) != kKnownNames.end())
      continue;
    warnings.push_back("no program reads the variable " + name + "; " + suggestion(name, kKnownNames));
  }
  std::sort(warnings.begin(), warnings.end());
  return warnings;
}

void check_environment() {
  const char* chaos = std::getenv("SKEIN_CHAOS");
  if (chaos != nullptr && !parse_whole(chaos)) {
    throw InputError(std::string("SKEIN_CHAOS=") + chaos + ": must be a whole number, or not set");
  }
}

std::string fleet_environment_prefix(bool native) {
  std::string prefix;
  for (const std::string& name : ignored_variables()) prefix += (prefix.empty() ? "env -u " : "-u ") + name + " ";
  for (const auto& [name, value] : pinned_variables(native)) prefix += name + "=" + value + " ";
  return prefix;
}

void settle_process() {
  // The shell may have closed a standard descriptor (`skein 2>&-`). Then the next pipe or lock file that is opened
  // would get its number, and the process would write its output or error messages there.
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
