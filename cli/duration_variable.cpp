#include "cli/duration_variable.hpp"

#include <algorithm>
#include <cstdlib>
#include <set>

#include "cli/option_checks.hpp"
#include "core/types.hpp"

namespace skein::cli {
namespace {

/// Commands that fly missions with an optional --duration.
const std::set<std::string> kFlyingCommands = {"run", "compose", "compare", "contest"};

}  // namespace

std::vector<std::string> with_duration_of_environment(std::vector<std::string> arguments) {
  const char* const duration = std::getenv(kDurationVariable);
  if (duration == nullptr || arguments.empty() || !kFlyingCommands.contains(arguments.front())) return arguments;
  const auto is_told = [](const std::string& word) { return word == "--duration" || word.starts_with("--duration="); };
  if (std::ranges::any_of(arguments, is_told)) return arguments;
  if (const std::string problem = check_seconds(duration); !problem.empty()) {
    throw InputError(std::string(kDurationVariable) + ": " + problem + ", or not set");
  }
  arguments.insert(arguments.begin() + 1, {"--duration", duration});  // at the end, it could come after "--"
  return arguments;
}

}  // namespace skein::cli
