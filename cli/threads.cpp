#include "cli/threads.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <string>
#include <string_view>

#include "cli/machine.hpp"
#include "core/types.hpp"

namespace skein::cli {
namespace {

std::optional<int> named_threads() {
  const char* const variable = std::getenv(kThreadsVariable);
  if (variable == nullptr || *variable == '\0') return std::nullopt;
  const std::string_view text = variable;
  int threads = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), threads);
  if (error == std::errc() && end == text.data() + text.size() && threads >= 1 && threads <= kMostThreads) {
    return threads;
  }
  throw InputError(std::string(kThreadsVariable) + ": '" + std::string(text) + "' must be a whole number from 1 to " +
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
