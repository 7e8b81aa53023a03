#include "host/threads.hpp"

#include <algorithm>
#include <cstdlib>
#include <string>

#include "core/text/whole_number.hpp"
#include "core/types.hpp"
#include "host/machine.hpp"

namespace skein::cli {
namespace {

std::optional<int> named_threads() {
  const char* const variable = std::getenv(kThreadsVariable);
  if (variable == nullptr || *variable == '\0') return std::nullopt;
  const auto threads = parse_whole<int>(variable);
  if (threads && *threads >= 1 && *threads <= kMostThreads) return threads;
  throw InputError(std::string(kThreadsVariable) + ": '" + variable + "' must be a whole number from 1 to " +
                   std::to_string(kMostThreads));
}

}  // namespace

int threads_of(const std::optional<int>& asked, std::size_t uavs) {
  if (asked) return *asked;
  if (const auto named = named_threads()) return *named;
  return std::clamp(std::min(usable_cores(), static_cast<int>(uavs)), 1, kMostThreads);
}

int threads_beside(std::size_t flights) {
  return std::clamp(usable_cores() / static_cast<int>(std::max<std::size_t>(1, flights)), 1, kMostThreads);
}

}  // namespace skein::cli
