#include "setup.hpp"

#include <cmath>
#include <cstdlib>
#include <locale>
#include <sstream>

namespace skein_ros {
namespace {

std::optional<std::string> variable(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? std::nullopt : std::optional<std::string>(value);
}

/// A time above 0; the node may have chosen another locale already. @returns nullopt for any other text.
std::optional<std::int64_t> nanoseconds(const std::string& seconds) {
  std::istringstream stream(seconds);
  stream.imbue(std::locale::classic());
  double value = 0.0;
  if (!(stream >> value) || !(value > 0.0) || value > 1e6) return std::nullopt;
  return std::llround(1e9 * value);
}

std::set<std::string> words(const std::string& text) {
  std::set<std::string> result;
  std::istringstream stream(text);
  for (std::string word; stream >> word;) result.insert(word);
  return result;
}

}  // namespace

std::optional<Setup> setup_of_environment() {
  const auto uav = variable("SKEIN_UAV");
  if (!uav || uav->empty()) return std::nullopt;
  Setup setup;
  setup.uav = *uav;
  if (const auto run = variable("SKEIN_RUN")) setup.run = std::strtoull(run->c_str(), nullptr, 10);
  if (const auto period = variable("SKEIN_EXCHANGE_S")) {
    if (const auto period_ns = nanoseconds(*period)) setup.exchange_ns = *period_ns;
  }
  setup.explorer = variable("SKEIN_ROLE") != "photographer";
  setup.radio_hears = {"/plan/" + *uav};
  if (const auto names = variable("SKEIN_RADIO_SENDS")) setup.radio_sends = words(*names);
  if (const auto names = variable("SKEIN_RADIO_HEARS")) setup.radio_hears = words(*names);
  if (const auto names = variable("SKEIN_DEBUG_VALUES")) setup.debug_values = words(*names);
  return setup;
}

}  // namespace skein_ros
