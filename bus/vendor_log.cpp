#include "bus/vendor_log.hpp"

#include <spdlog/spdlog.h>

#include <mutex>
#include <set>

namespace skein::bus {

namespace {

constexpr std::size_t kMostTexts = 48;

/// Texts logged so far. Static, because vendors log for the whole process, from all of their threads.
struct Heard {
  std::mutex mutex;
  std::set<std::string, std::less<>> texts;
};

Heard& heard() {
  static Heard all;
  return all;
}

}  // namespace

void log_refusal(std::string_view vendor, std::string_view text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.remove_suffix(1);
  Heard& known = heard();
  const std::scoped_lock lock(known.mutex);
  if (known.texts.size() >= kMostTexts || !known.texts.emplace(text).second) return;
  spdlog::warn("security, {}: {}", vendor, text);
  if (known.texts.size() == kMostTexts) spdlog::warn("security: no more of these are logged");
}

}  // namespace skein::bus
